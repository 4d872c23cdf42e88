#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Switches off or spoils one term of the simulator's physics after the other, in a copy of the tree, and demands that
# the test named beside it fails. Prints a table; 1 if a mutation survives, 2 if one cannot be tried.
#
#   tests/mutations/run.sh [--only TEXT] [--list] [--check] [--table FILE] [--work FOLDER] [--jobs N]
#
#   --only TEXT    only mutations whose term holds this text, or whose equation id it is
#   --list         says what would be tried, and does nothing
#   --check        only checks that every old text occurs once in its file and every test exists (the test layers.mutations_apply)
#   --table FILE   other mutations than those of mutations.txt
#   --work FOLDER  copy and build there and leave it: the next run need not build everything again
#   --jobs N       compile jobs at once (1)
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
table=$here/mutations.txt only="" mode=run work="" jobs=1
while (($#)); do
  case $1 in
    --only) only=$2 && shift 2 ;;
    --table) table=$2 && shift 2 ;;
    --work) work=$2 && shift 2 ;;
    --jobs) jobs=$2 && shift 2 ;;
    --list | --check) mode=${1#--} && shift ;;
    *) sed -n '6,13s/^# \{0,1\}//p' "$0" >&2 && exit 2 ;;
  esac
done

# One line per mutation: term, id ("-" if none), file, old text, new text and test, separated by the character 31.
mutations() {
  perl -e '
    use strict;
    my ($table, $only) = @ARGV;
    open(my $in, "<", $table) or die "$table: $!\n";
    my ($file, @m);
    while (<$in>) {
      s/\s+$//;
      next if /^#/ || $_ eq "";
      if (!@m && /^@ (\S+)$/) { $file = $1 }
      elsif (!@m && defined $file && /^(?:(E\d+) )?(.+): (\w+ \S+)$/) { @m = ($2, $1 // "-", $file, $3) }
      elsif (@m == 4 && /^- (.+)/) { splice @m, 3, 0, $1 }
      elsif (@m == 5 && /^\+(?: (.*))?$/) {
        splice @m, 4, 0, $1 // "";
        print join("\x1f", @m), "\n" if $only eq "" || index(lc $m[0], lc $only) >= 0 || $m[1] eq $only;
        @m = ();
      }
      else { die "$table:$.: not the next line of a mutation (@ file; term: test; - old; + new): $_\n" }
    }
    die "$table: ends within a mutation\n" if @m;' "$table" "$only"
}

# Complains of every mutation on stdin that does not fit the code, or whose (first) test does not exist.
check() {
  perl -e '
    use strict;
    my ($root, $stale, %text) = (shift, 0);
    my $read = sub { local $/; open(my $in, "<", "$root/$_[0]") or return ""; <$in> };
    my $complain = sub { warn "@_\n"; $stale = 1 };
    my $known = $read->("docs/equations.md");
    my $tests = join "", map { s/.*[(]//r } qx{cd "$root" && grep -rhoE "^(TYPED_)?TEST(_[FP])?[(]\\w+,\\s*\\w+" tests};
    while (<>) {
      chomp;
      my ($term, $id, $file, $old, $new, $filter) = split /\x1f/;
      $complain->("$term: docs/equations.md has no $id") if $id ne "-" && index($known, "| $id |") < 0;
      $complain->("$term: changes nothing") if $old eq $new;
      my ($suite, $name, $more) = $filter =~ m{^\w+ (?:\w+/)?([\w*]+)\.(\w*)(\*?)} or next;
      $suite =~ s/\*/\\w*/g;
      $complain->("$term: there is no test $filter") if $tests !~ ($more ? qr/^$suite,\s*$name/m : qr/^$suite,\s*$name$/m);
      my $times = () = ($text{$file} //= $read->($file)) =~ /(?=\Q$old\E)/g;
      $complain->("$term: does not apply: the old text occurs $times times in $file, must occur once: $old") if $times != 1;
    }
    exit($stale ? 2 : 0);' "$root"
}

list=$(mutations)
[[ -n $list ]] || { echo "no mutation holds '$only'" >&2; exit 2; }

if [[ $mode == list ]]; then
  while IFS=$'\x1f' read -r term id file old new tests; do
    printf '%s (%s), %s: %s\n    - %s\n    + %s\n' "$term" "$id" "$file" "$tests" "$old" "$new"
  done <<<"$list"
  exit 0
fi

# A table that does not fit the code tries nothing: say so before anything is built.
check <<<"$list" || exit 2
[[ $mode == check ]] && { echo "$(wc -l <<<"$list") mutations apply"; exit 0; }

# The copy. What differs is copied anew, with the time of now: also what an interrupted run left spoiled.
if [[ -z $work ]]; then
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi
mkdir -p "$work/tree"
work=$(cd "$work" && pwd)
(cd "$root" && find . \( -path ./.git -o -path ./build -o -path ./out \) -prune -o -type f -print) |
  while read -r file; do
    cmp -s "$root/$file" "$work/tree/$file" && continue
    mkdir -p "$(dirname "$work/tree/$file")"
    cp --preserve=mode "$root/$file" "$work/tree/$file"
  done

# Built once; every test that is to fail must first pass.
launcher=()
export CCACHE_BASEDIR=$work
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
log=$work/log
cmake -S "$work/tree" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DINSONIFY_VIEW=ON -DINSONIFY_SCENE_IO=ON \
  "${launcher[@]}" >"$log" 2>&1 || { cat "$log" >&2; exit 2; }
stale=0
complain() { echo "$*" >&2; stale=$((stale + 1)); }
build() { ninja -C "$work/build" -j "$jobs" "$1" >"$log" 2>&1; }
try() { timeout 300 "$work/build/bin/$1" --gtest_filter="$2" --gtest_fail_fast --gtest_brief=1 >"$log" 2>&1; }
while read -r program filter; do
  build "$program" </dev/null || { tail -20 "$log" >&2; echo "$program does not build" >&2; exit 2; }
  try "$program" "$filter" </dev/null || { grep FAILED "$log" >&2; complain "$program $filter fails without a mutation"; }
  grep -q '\] 0 tests from' "$log" && complain "$program has no test $filter"
done < <(cut -d$'\x1f' -f6 <<<"$list" | sort -u)
((stale == 0)) || exit 2

# One mutation after the other.
survivors=0 errors=0 tried=0
echo "| term | equation | file | first test to fail |"
echo "|---|---|---|---|"
while IFS=$'\x1f' read -r term id file old new tests; do
  program=${tests%% *} filter=${tests#* }
  cp "$work/tree/$file" "$work/kept"
  OLD=$old NEW=$new perl -0777 -pi -e 's/\Q$ENV{OLD}/$ENV{NEW}/' "$work/tree/$file"
  if ! build "$program" </dev/null; then
    verdict="ERROR: does not build"
    errors=$((errors + 1))
    grep -m 3 'error' "$log" >&2 || tail -3 "$log" >&2
  elif try "$program" "$filter" </dev/null; then
    verdict="SURVIVES: none of $tests"
    survivors=$((survivors + 1))
  else
    failed=$(perl -ne 'if (/^\[  FAILED  \] ([\w\/]+\.[\w\/]+)/) { print $1; exit }' "$log")
    verdict=\`${failed:-crash or time-out of $tests}\`
  fi
  # Restored with the time of now, so that it is compiled again.
  cat "$work/kept" >"$work/tree/$file"
  tried=$((tried + 1))
  echo "| $term | $id | \`$file\` | $verdict |"
done <<<"$list"
echo
echo "$tried mutations, $survivors survive, $errors could not be tried"
((errors == 0)) || exit 2
((survivors == 0)) || exit 1
