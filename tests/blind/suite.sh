#!/bin/sh
# The blind suite: docs/explanation/proof.md.
#
#   suite.sh BUILD SET              all of it: make, seal, diagnose, score
#   suite.sh BUILD SET make         simulates the cases of sets/SET.txt and seals their truths
#   suite.sh BUILD SET diagnose     answers every case, in a process that can read nothing else; after an
#                                   interruption the same dynid continues with the cases without an answer
#   suite.sh BUILD SET baselines    the same with simpler methods
#   suite.sh BUILD SET active       lets dynid ask for one more recording where several names remain, makes
#                                   it, and has the case answered again
#   suite.sh BUILD SET strength     lambda of the single effects without the stiction intervals, in which
#                                   friction can take any value
#   suite.sh BUILD SET reach        chi-square of single and foreign effects in the equations of dynid
#   suite.sh BUILD SET score        compares the answers with the truth
#   suite.sh BUILD real [STEP]      make, diagnose, score of real recordings with an added effect
#   suite.sh BUILD case KIND LAMBDA SEED [habit=NAME] [FAMILY]    one case: its truth, its answer, its report
#
# A line of a set: kind, lambda, number of cases, first seed; then an arm ("small": planar2 or twisted4) and a
# family, and anywhere among them habit=NAME.
#
# BUILD is a configured build folder: the targets blind and dynid are built if they are missing. Real
# recordings are in DYNGEN_SHARED_DATA, else in ../shared/data beside the project; without them the set is skipped.
# UNSEALED=allowed accepts a kernel that cannot seal: a comparison, but no proof. Output goes to
# BUILD/blind/SET, pictures to PICTURES if it is set. JOBS processes work at once.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$1" && pwd)
set_name=$2
step=${3:-all}
jobs=${JOBS:-$(nproc)}
tools=$build/tests/blind
dynid=$build/runtime/dynid
out=$build/blind/$set_name
seal=$here/seals/$set_name.sha256
export OUT="$out" TOOLS="$tools" DYNID="$dynid"

begin_cases() {
  rm -rf "$out"
  mkdir -p "$out/sealed/entries"
  chmod 700 "$out/sealed"
}

make_cases() {
  begin_cases
  grep -v -e '^#' -e '^bound' -e '^$' "$here/sets/$set_name.txt" | while read -r kind lambda cases seed rest; do
    [ "$lambda" = 0 ] && lambda=1
    arm=
    family=
    habit=
    for word in $rest; do
      case "$word" in
        habit=*) habit=${word#habit=} ;;
        *) if [ -z "$arm" ]; then arm=$word; else family=$word; fi ;;
      esac
    done
    part=0
    while [ $part -lt "$jobs" ]; do
      echo "--kind $kind --lambda $lambda --cases $cases --seed $seed --part $part --parts $jobs ${arm:+--arm $arm} ${family:+--family $family} ${habit:+--habit $habit}"
      part=$((part + 1))
    done
  done | xargs -P "$jobs" -I{} sh -c "$tools/blind_make {} --arms $here/arms --out $out/cases --sealed $out/sealed/entries"
  seal_cases
}

# The manifest: all entries, by the names of the cases.
seal_cases() {
  {
    echo "["
    separator=""
    for entry in "$out"/sealed/entries/*.json; do
      printf '%s' "$separator"
      cat "$entry"
      separator=","
    done
    echo "]"
  } >"$out/sealed/manifest.json"
  rm -r "$out/sealed/entries"
  (cd "$out/sealed" && sha256sum manifest.json) >"$out/manifest.sha256"
  echo "$(find "$out/cases" -mindepth 1 -maxdepth 1 | wc -l) cases; sealed as"
  cat "$out/manifest.sha256"
}

# Recordings of real robots as they are, and with something added.
spoil_recordings() {
  begin_cases
  grep -v '^#' "$here/sets/real.txt" | while read -r recording family strength seed joint; do
    echo "--recording $recording --family $family ${strength:+--strength $strength} --seed $seed ${joint:+--joint $joint}"
  done | xargs -P "$jobs" -I{} sh -c "$tools/blind_spoil {} --data $data --project $here/../.. --out $out/cases --sealed $out/sealed/entries"
  seal_cases
}

# The truths were fixed before the diagnosis: a set with a committed seal is that set.
check_seal() {
  (cd "$out/sealed" && sha256sum --quiet -c ../manifest.sha256)
  if [ -f "$seal" ] && ! cmp -s "$seal" "$out/manifest.sha256"; then
    echo "$set_name: the manifest is not the one that seals/$set_name.sha256 seals" >&2
    exit 1
  fi
}

diagnose_cases() {
  check_seal
  sha256sum "$dynid" >"$out/diagnosed_by.now"
  if [ -f "$out/answers.sha256" ] || ! cmp -s "$out/diagnosed_by" "$out/diagnosed_by.now"; then
    rm -rf "$out/answers" "$out/answers.sha256"
  fi
  mv "$out/diagnosed_by.now" "$out/diagnosed_by"
  mkdir -p "$out/answers"
  find "$out/cases" -mindepth 1 -maxdepth 1 | sort | xargs -P "$jobs" -I{} sh -c '
    name=$(basename {})
    if [ -f "$OUT/answers/$name.json" ]; then exit; fi
    begin=$(date +%s)
    recordings=$(cd {} && ls train*.csv; cd {} && ls held*.csv 2>/dev/null | sed "s/^/--holdout /")
    timeout 1200 "$TOOLS/blind_sealed_run" {} "$OUT/answers" "$DYNID" diagnose robot.robot $recordings \
      --json "$OUT/answers/$name.json" -o "$OUT/answers/$name.robot" >"$OUT/answers/$name.txt" 2>&1 ||
      echo "$name: dynid ended with $?"
    echo "$name $(($(date +%s) - begin)) s"'
  (cd "$out/answers" && sha256sum ./*.json) >"$out/answers.sha256"
  echo "answers sealed as $(sha256sum <"$out/answers.sha256" | cut -d' ' -f1)"
}

answer_simply() {
  check_seal
  rm -rf "$out/baselines"
  mkdir -p "$out/baselines"
  find "$out/cases" -mindepth 1 -maxdepth 1 | sort | xargs -P "$jobs" -I{} sh -c '
    recordings=$(cd {} && ls train*.csv; cd {} && ls held*.csv | sed "s/^/--holdout /")
    timeout 1200 "$TOOLS/blind_sealed_run" {} "$OUT/baselines" "$TOOLS/blind_baselines" robot.robot $recordings \
      --json "$OUT/baselines/$(basename {}).json" || echo "{}: blind_baselines ended with $?"'
  (cd "$out/baselines" && sha256sum ./*.json) >"$out/baselines.sha256"
  echo "answers of simpler methods sealed as $(sha256sum <"$out/baselines.sha256" | cut -d' ' -f1)"
}

# The program that moves the machine knows the truth; dynid gets only the new recording.
active_cases() {
  check_seal
  (cd "$out/answers" && sha256sum --quiet -c ../answers.sha256)
  rm -rf "$out/asked" "$out/second"
  mkdir -p "$out/asked" "$out/second"
  rm -f "$out"/cases/*/asked.csv
  { grep -l '"purpose": "' "$out"/answers/*.json || true; } | xargs -P "$jobs" -I{} sh -c '
    name=$(basename {} .json)
    cp {} "$OUT/asked/$name.findings"
    timeout 1200 "$TOOLS/blind_sealed_run" "$OUT/cases/$name" "$OUT/asked" "$DYNID" excite robot.robot \
      --for "$OUT/asked/$name.findings" --evaluations 3000 --json "$OUT/asked/$name.json" \
      -o "$OUT/asked/$name.csv" >"$OUT/asked/$name.txt" 2>&1 || echo "$name: dynid excite ended with $?"'
  part=0
  while [ $part -lt "$jobs" ]; do
    echo "--part $part --parts $jobs"
    part=$((part + 1))
  done | xargs -P "$jobs" -I{} sh -c "$tools/blind_answer $out/sealed/manifest.json {} --arms $here/arms \
    --cases $out/cases --asked $out/asked"
  find "$out/cases" -name asked.csv | sort | xargs -P "$jobs" -I{} sh -c '
    case=$(dirname {})
    name=$(basename "$case")
    recordings=$(cd "$case" && ls train*.csv && ls asked.csv; cd "$case" && ls held*.csv | sed "s/^/--holdout /")
    timeout 1200 "$TOOLS/blind_sealed_run" "$case" "$OUT/second" "$DYNID" diagnose robot.robot $recordings \
      --json "$OUT/second/$name.json" -o "$OUT/second/$name.robot" >"$OUT/second/$name.txt" 2>&1 ||
      echo "$name: dynid ended with $?"'
  (cd "$out" && find asked second -type f | sort | xargs sha256sum) >"$out/second.sha256"
  echo "second answers sealed as $(sha256sum <"$out/second.sha256" | cut -d' ' -f1)"
}

measure_strength() {
  check_seal
  "$tools/blind_strength" "$out/sealed/manifest.json" --arms "$here/arms" --jobs "$jobs" --out "$out/strengths.json"
}

measure_reach() {
  check_seal
  "$tools/blind_reach" "$out/sealed/manifest.json" --arms "$here/arms" --cases "$out/cases" --out "$out/reach.json"
}

score_cases() {
  code=0
  check_seal
  if [ -f "$out/second.sha256" ]; then (cd "$out" && sha256sum --quiet -c second.sha256); fi
  (cd "$out/answers" && sha256sum --quiet -c ../answers.sha256)
  rm -rf "$out/figures"
  more=
  if [ -d "$out/baselines" ]; then
    (cd "$out/baselines" && sha256sum --quiet -c ../baselines.sha256)
    more="--baselines $out/baselines"
  fi
  if [ -f "$out/strengths.json" ]; then more="$more --strengths $out/strengths.json"; fi
  if [ -f "$out/reach.json" ]; then more="$more --reach $out/reach.json"; fi
  if [ -d "$out/second" ]; then more="$more --asked $out/asked --second $out/second"; fi
  # shellcheck disable=SC2046,SC2086  # options, in words
  "$tools/blind_score" "$out/sealed/manifest.json" "$out/answers" --lines "$out/lines.txt" \
    --figures "$out/figures" $more \
    $(sed -n 's/^bound //p' "$here/sets/$set_name.txt") || code=$?
  if command -v gnuplot >/dev/null; then
    pictures=${PICTURES:-$out/figures}
    mkdir -p "$pictures"
    gnuplot -e "folder='$out/figures'; pictures='$pictures'" "$here/score/proof.gnuplot"
  fi
  return "$code"
}

score_real() {
  check_seal
  (cd "$out/answers" && sha256sum --quiet -c ../answers.sha256)
  "$tools/blind_score" --real "$out/sealed/manifest.json" "$out/answers"
}

one_case() {
  set_name=case
  out=$build/blind/case
  rm -rf "$out"
  family=${4:-}
  habit=
  case $family in
    habit=*)
      habit=${family#habit=}
      family=${5:-}
      ;;
  esac
  "$tools/blind_make" --kind "$1" --lambda "$2" --seed "$3" ${family:+--family "$family"} ${habit:+--habit "$habit"} --cases 1 \
    --arms "$here/arms" --out "$out/cases" --sealed "$out/sealed"
  cd "$out"/cases/*
  echo "the truth:"
  cat "$out"/sealed/*.json
  # shellcheck disable=SC2012,SC2046  # names without blanks, in words
  "$dynid" diagnose robot.robot $(ls train*.csv) $(ls held*.csv | sed "s/^/--holdout /") --json "$out/answer.json" -o "$out/improved.robot" --report "$out/report.html"
  echo "report: $out/report.html"
}

if [ ! -x "$tools/blind_make" ] || [ ! -x "$dynid" ]; then
  cmake --build "$build" --parallel "$jobs" --target blind dynid
fi

data=${DYNGEN_SHARED_DATA:-$here/../../../shared/data}
if [ "$set_name" = real ] && [ ! -f "$data/tx40/tx40.csv" ]; then
  echo "skipped: $data holds no real recordings; DYNGEN_SHARED_DATA is the folder of them"
  exit 0
fi

case "$set_name/$step" in
  case/*) shift 2; one_case "$@" ;;
  real/all) spoil_recordings; diagnose_cases; score_real ;;
  real/make) spoil_recordings ;;
  real/score) score_real ;;
  */all) make_cases; diagnose_cases; answer_simply; score_cases ;;
  */make) make_cases ;;
  */diagnose) diagnose_cases ;;
  */active) active_cases ;;
  */baselines) answer_simply ;;
  */strength) measure_strength ;;
  */reach) measure_reach ;;
  */score) score_cases ;;
  *) sed -n '2,24p' "$0"; exit 2 ;;
esac
