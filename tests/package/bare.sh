#!/bin/sh
# bare.sh [PART...]: what a stranger does, on a bare Debian 12.
#
# Makes a Debian 12 tree that holds nothing but what Debian calls minimal, copies a clean clone of this checkout into it,
# and runs there, as root and without sudo, exactly what the README says. Parts, one after the other:
#
#   demo      sh cmake/demo.sh
#   test      sh cmake/test.sh
#   parts     optional packages: configured with none, with each alone and with all; built and used with none
#
# Without PART: all three. Each part begins in a fresh copy of the minimal tree.
#   BARE_CACHE    folder of the trees, made where it is absent ($XDG_CACHE_HOME/dyngen/bare, else ~/.cache/dyngen/bare)
#   BARE_CCACHE   folder of a compiler cache that the tree uses too; without it every compilation is done
#   BARE_ARTIFACTS  folder that receives ctest.log and the logs of all parts
# Needs root (chroot), a Debian 12 with its package sources, and the package debootstrap, which it installs.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
project=$(cd "$here/../.." && pwd)
cache=${BARE_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/dyngen/bare}
artifacts=${BARE_ARTIFACTS:-$cache/logs}
ccache=${BARE_CCACHE:-}
base=$cache/base
tree=$cache/tree
# Within the tree, at the path that it has here: both are the same to a compiler cache.
clone=$project
times=$artifacts/times.txt

fail() {
  echo "bare.sh: $*" >&2
  exit 1
}
seconds() { date +%s; }

[ "$(id -u)" -eq 0 ] || fail "this needs root: a bare tree is entered by chroot"
case ${1:-} in -h | --help) sed -n '2,17p' "$0"; exit 0 ;; esac
mkdir -p "$cache" "$artifacts"
: >"$times"

# Where this machine's packages come from: address and suite of each Debian source.
sources() {
  apt-get indextargets --format '$(SITE) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
    awk '$2 ~ /^bookworm/ && $3 == "main" {print $1, $2}' | sort -u
}

make_base() {
  sh "$project/cmake/install_packages.sh" debootstrap
  sources >"$cache/sources"
  mirror=$(awk '$2 == "bookworm" {print $1; exit}' "$cache/sources")
  [ -n "$mirror" ] || fail "this machine's apt has no source of bookworm main (apt-get update?)"
  echo "Making a minimal Debian 12 in $base ..."
  rm -rf "$base" "$base.complete"
  debootstrap --variant=minbase bookworm "$base" "$mirror" >"$artifacts/debootstrap.log" 2>&1 || {
    tail -n 20 "$artifacts/debootstrap.log" >&2
    fail "debootstrap failed; all of its output is in $artifacts/debootstrap.log"
  }
  awk '{print "deb", $1, $2, "main"}' "$cache/sources" >"$base/etc/apt/sources.list"
  # what this machine's apt was told of its sources, a proxy for instance
  for file in /etc/apt/apt.conf.d/*; do
    if grep -qi -e '^Acquire::' "$file"; then cp "$file" "$base/etc/apt/apt.conf.d/"; fi
  done
  touch "$base.complete"
}

release_tree() {
  while grep -q " $tree/" /proc/mounts; do
    umount -l "$(awk -v tree="$tree/" 'index($2, tree) == 1 {print $2}' /proc/mounts | sort -r | head -n 1)" || break
  done
}
trap release_tree EXIT
trap 'exit 1' INT TERM HUP

# A fresh tree with a clean clone, and recordings beside it where this machine has them.
fresh_tree() {
  release_tree
  # never below a mount
  if grep -q " $tree/" /proc/mounts; then fail "$tree has something mounted"; fi
  rm -rf "$tree"
  cp -a "$base" "$tree"
  cp /etc/resolv.conf "$tree/etc/resolv.conf"
  # debootstrap leaves to the installer what every installed Debian has; without it a name server is asked for localhost
  printf '127.0.0.1 localhost\n' >"$tree/etc/hosts"
  mkdir -p "$tree$(dirname "$clone")"
  git -c safe.directory='*' clone -q --no-hardlinks "$project" "$tree$clone"
  mkdir -p "$tree/dev/shm"
  mount --bind /proc "$tree/proc"
  # copied, not mounted: nothing that goes wrong in the tree can reach them
  if [ -d "$project/../shared/data" ]; then
    mkdir -p "$tree$(dirname "$clone")/shared/data"
    cp -a "$project/../shared/data/." "$tree$(dirname "$clone")/shared/data"
  fi
  launcher=
  if [ -n "$ccache" ]; then
    sh "$project/cmake/install_packages.sh" ccache
    # nothing is lost with this tree: packages need not wait for the disk
    echo force-unsafe-io >"$tree/etc/dpkg/dpkg.cfg.d/unsafe-io"
    # the program and its libraries beside the system, which does not learn of them
    mkdir -p "$ccache" "$tree/opt/ccache/cache" "$tree/opt/ccache/program"
    cp "$(command -v ccache)" "$tree/opt/ccache/program/ccache"
    ldd "$(command -v ccache)" | sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p' | xargs cp -t "$tree/opt/ccache/program"
    # those of the C library have to be the tree's own
    rm -f "$tree"/opt/ccache/program/libc.so* "$tree"/opt/ccache/program/libm.so* "$tree"/opt/ccache/program/libpthread.so*
    printf '#!/bin/sh\nLD_LIBRARY_PATH=/opt/ccache/program exec /opt/ccache/program/ccache "$@"\n' >"$tree/opt/ccache/ccache"
    chmod +x "$tree/opt/ccache/ccache"
    mount --bind "$ccache" "$tree/opt/ccache/cache"
    launcher=/opt/ccache/ccache
  fi
}

# in_tree NAME COMMAND...: runs it in the clone, with nothing of this environment; tells what it took.
in_tree() {
  name=$1
  shift
  start=$(seconds)
  log=$artifacts/$name.log
  echo
  echo "=== bare: $*"
  code=0
  if [ -n "$launcher" ]; then
    set -- env CMAKE_C_COMPILER_LAUNCHER=$launcher CMAKE_CXX_COMPILER_LAUNCHER=$launcher \
      CCACHE_DIR=/opt/ccache/cache CCACHE_BASEDIR="$clone" CCACHE_NOHASHDIR=1 CCACHE_COMPILERCHECK=content \
      CCACHE_SLOPPINESS=pch_defines,time_macros "$@"
  fi
  { env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
      chroot "$tree" sh -c 'cd "$1" && shift && exec "$@"' sh "$clone" "$@" 2>&1 </dev/null || echo $? >"$artifacts/code"; } |
    tee "$log"
  if [ -f "$artifacts/code" ]; then
    code=$(cat "$artifacts/code")
    rm "$artifacts/code"
  fi
  sed -n "s/^(\(.*: [0-9]* s\))$/$name: \1/p" "$log" >>"$times"
  echo "$name, all: $(($(seconds) - start)) s" >>"$times"
  [ "$code" -eq 0 ] || fail "'$*' ended with $code in a bare tree"
}

keep() {
  for file in "$@"; do
    if [ -f "$tree$clone/$file" ]; then cp "$tree$clone/$file" "$artifacts/"; fi
  done
}

start=$(seconds)
rm -f "$artifacts/code"
if [ ! -f "$base.complete" ]; then
  make_base
  echo "minimal tree: $(($(seconds) - start)) s" >>"$times"
fi
git -c safe.directory='*' -C "$project" diff --quiet HEAD ||
  echo "Note: changes that are not committed are not in the clone."

[ $# -gt 0 ] || set -- demo test parts
for part in "$@"; do
  case $part in
    demo)
      fresh_tree
      in_tree demo sh cmake/demo.sh
      keep build/quick.log build/quick/puma560.c
      ;;
    test)
      fresh_tree
      in_tree test sh cmake/test.sh
      keep build/quick/ctest.log build/quick/.ninja_log
      ;;
    parts)
      fresh_tree
      in_tree parts sh tests/package/optional_parts.sh
      ;;
    *) fail "unknown part '$part'; expected demo, test, parts" ;;
  esac
done

echo
echo "=== times in a bare tree"
cat "$times"
