# SPDX-License-Identifier: BSD-3-Clause
# Sourced by the scripts that make a page of pictures. Needs no display.
# begin_page NAME TOOL [keep]: the page is docs/results/NAME.md, its pictures are in docs/images/NAME, which is emptied unless
# `keep`; the commands run in a folder of their own. `insonify` is the tool, which says nothing but errors.
most_bytes=700000  # of a picture

begin_page() {
  root=$PWD
  tool=$(realpath "$2")
  [[ -f $tool && -x $tool ]] || { echo "$0: $2 is not a program; give the path of insonify" >&2; exit 2; }
  pictures=$root/docs/images/$1
  page=$root/docs/results/$1.md
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  [[ ${3:-} == keep ]] || rm -rf "$pictures"
  mkdir -p "$pictures"
  cd "$work"
}
insonify() { "$tool" "$@" -q >/dev/null; }

# keep_picture NAME: moves NAME.png to the pictures of the page.
keep_picture() {
  [[ $(stat -c %s "$1.png") -lt $most_bytes ]] || { echo "$0: $1.png is larger than $most_bytes bytes" >&2; exit 1; }
  mv "$1.png" "$pictures/"
}

# picture NAME CAPTION COMMAND: runs the command, which writes NAME.png, and shows the picture under its caption.
picture() {
  eval "$3"
  keep_picture "$1"
  printf '\n%s\n\n```\n%s\n```\n\n![%s](../images/%s/%s.png)\n' "$2" "$3" "$2" "${pictures##*/}" "$1" >>"$page"
}

# steps COMMAND...: runs and lists the commands that the next pictures need.
steps() {
  printf '\n```\n' >>"$page"
  for command in "$@"; do
    printf '%s\n' "$command" >>"$page"
    eval "$command"
  done
  printf '```\n' >>"$page"
}
