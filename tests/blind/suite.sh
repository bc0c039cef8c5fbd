#!/bin/sh
# The blind suite: docs/proof.md.
#
#   suite.sh BUILD SET              all of it: make, seal, diagnose, score
#   suite.sh BUILD SET make         simulates the cases of sets/SET.txt and seals what is in them
#   suite.sh BUILD SET diagnose     answers every case, in a process that can read nothing else
#   suite.sh BUILD SET score        holds the answers against the truth
#   suite.sh BUILD case KIND LAMBDA SEED [FAMILY]    one case, told in full
#
# BUILD is a build folder with the targets blind_make, blind_sealed_run, blind_score and dynid;
# everything is written to BUILD/blind/SET. JOBS processes work at once.
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

make_cases() {
  rm -rf "$out"
  mkdir -p "$out/sealed/entries"
  chmod 700 "$out/sealed"
  grep -v -e '^#' -e '^bound' "$here/sets/$set_name.txt" | while read -r kind lambda cases seed arm; do
    [ "$lambda" = 0 ] && lambda=1
    part=0
    while [ $part -lt "$jobs" ]; do
      echo "--kind $kind --lambda $lambda --cases $cases --seed $seed --part $part --parts $jobs ${arm:+--arm $arm}"
      part=$((part + 1))
    done
  done | xargs -P "$jobs" -I{} sh -c "$tools/blind_make {} --arms $here/arms --out $out/cases --sealed $out/sealed/entries"
  # the manifest: all entries, by the names of the cases
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

# What is in the cases was fixed before they were diagnosed: a set with a committed seal is that set.
check_seal() {
  (cd "$out/sealed" && sha256sum --quiet -c ../manifest.sha256)
  if [ -f "$seal" ] && ! cmp -s "$seal" "$out/manifest.sha256"; then
    echo "$set_name: the manifest is not the one that seals/$set_name.sha256 seals" >&2
    exit 1
  fi
}

diagnose_cases() {
  check_seal
  mkdir -p "$out/answers"
  find "$out/cases" -mindepth 1 -maxdepth 1 | sort | xargs -P "$jobs" -I{} sh -c '
    name=$(basename {})
    begin=$(date +%s)
    timeout 1200 "$TOOLS/blind_sealed_run" {} "$OUT/answers" "$DYNID" diagnose robot.robot \
      train1.csv train2.csv train3.csv --holdout held1.csv --holdout held2.csv \
      --json "$OUT/answers/$name.json" -o "$OUT/answers/$name.robot" >"$OUT/answers/$name.txt" 2>&1 ||
      echo "$name: dynid ended with $?"
    echo "$name $(($(date +%s) - begin)) s"'
  (cd "$out/answers" && sha256sum ./*.json) >"$out/answers.sha256"
  echo "answers sealed as $(sha256sum <"$out/answers.sha256" | cut -d' ' -f1)"
}

score_cases() {
  check_seal
  (cd "$out/answers" && sha256sum --quiet -c ../answers.sha256)
  # shellcheck disable=SC2046  # options, in words
  "$tools/blind_score" "$out/sealed/manifest.json" "$out/answers" --lines "$out/lines.txt" \
    $(sed -n 's/^bound //p' "$here/sets/$set_name.txt")
}

one_case() {
  set_name=case
  out=$build/blind/case
  rm -rf "$out"
  "$tools/blind_make" --kind "$1" --lambda "$2" --seed "$3" ${4:+--family "$4"} --cases 1 \
    --arms "$here/arms" --out "$out/cases" --sealed "$out/sealed"
  cd "$out"/cases/*
  echo "what is in it:"
  cat "$out"/sealed/*.json
  "$dynid" diagnose robot.robot train1.csv train2.csv train3.csv --holdout held1.csv \
    --holdout held2.csv --json "$out/answer.json" -o "$out/improved.robot" --report "$out/report.html"
  echo "report: $out/report.html"
}

case "$set_name/$step" in
  case/*) shift 2; one_case "$@" ;;
  */all) make_cases; diagnose_cases; score_cases ;;
  */make) make_cases ;;
  */diagnose) diagnose_cases ;;
  */score) score_cases ;;
  *) sed -n '2,13p' "$0"; exit 2 ;;
esac
