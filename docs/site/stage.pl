#!/usr/bin/env perl
# SPDX-License-Identifier: BSD-3-Clause
# Puts what Doxygen reads into FOLDER:
#   insonify/MODULE/*.hpp   the public headers, each in the group of its module; (E12) links to that row of the equations
#   pages/*.md              README.md, docs/*.md, docs/results/*.md and docs/reference/*.md: a page's label is its name (of results: results-NAME), a heading's is NAME-ITS-WORDS
#   files/                  other files that the pages link to
use strict;
use warnings;
use File::Basename;
use File::Copy;
use File::Path 'make_path';

my $stage = shift or die "usage: stage.pl FOLDER\n";
make_path("$stage/pages", "$stage/files");

sub slurp { my ($path) = @_; open(my $in, '<', $path) or die "$path: $!\n"; local $/; return <$in> }
sub spew { my ($path, $text) = @_; make_path(dirname $path); open(my $out, '>', $path) or die "$path: $!\n"; print $out $text }
sub label { my ($heading) = @_; return lc($heading =~ s/[^\w\s-]//gr) =~ s/\s+/-/gr }
sub equations { return $_[0] =~ s{(?<![\w#">/])(E\d+)\b}{<a href="equations.html#$1">$1</a>}gr }

# Groups: the rows of the table of components.
my ($groups, %known) = ('');
for (slurp('docs/api.md') =~ /^\| (`\w+` \| [^|]+?) \|/mg) {
  my ($name, $what) = /`(\w+)` \| (.*)/;
  $known{$name} = 1;
  $groups .= "/// \@defgroup $name $name: " . ($what =~ s/`//gr) . "\n";
}
spew("$stage/insonify/groups.dox", "$groups/// \@namespace insonify\n/// All of the library.\n");

for my $path (grep { !/_internal\.hpp$/ } glob 'modules/*/*.hpp') {
  my ($module) = $path =~ m{^modules/(\w+)/};
  next if slurp("modules/$module/CMakeLists.txt") =~ /TOOL_ONLY/;
  die "docs/api.md has no component $module\n" unless $known{$module};
  my $text = slurp($path);
  $text =~ s{^#include "([a-z_]+/[a-z0-9_]+\.hpp)"}{#include <insonify/$1>}mg;
  $text =~ s/^ private:\n.*?^(?=\};)//msg;
  $text =~ s{^(\s*///.*|.*?///<.*)$}{equations($1) =~ s/(?<=\w)\@(?=[A-Z])/\\@/gr}meg;  # NAME@LAW is no command
  $text =~ s{^(namespace insonify(?:::\w+)? \{)$}{$1\n/// \@addtogroup $module\n/// \@\{}mg;
  $text =~ s{^(\}  // namespace insonify(?:::\w+)?)$}{/// \@\}\n$1}mg;
  spew($path =~ s{^modules}{$stage/insonify}r, $text);
}

for my $path ('README.md', glob('docs/*.md'), glob('docs/results/*.md'), glob('docs/reference/*.md')) {
  my $page = page_of($path);
  my $folder = $path eq 'README.md' ? '' : dirname($path) . '/';
  my ($fenced, $first, $text, %seen) = (0, 1, '');
  for my $line (split /^/, slurp($path)) {
    if ($line =~ /^\s*```/) { $fenced = !$fenced; $line =~ s/```\w+/$line =~ m{```(cpp|cmake|toml)} && $1 eq 'cpp' ? '```{.cpp}' : '```'/e }
    if ($fenced) { $text .= $line; next }
    if ($line =~ /^(#+) (.*?)\s*$/) {
      my ($marks, $heading) = ($1, $2);
      my $label = $first ? $page : "$page-" . label($heading);
      my $count = $seen{$label}++;
      $label .= "-$count" if $count;
      $line = "$marks $heading {#$label}\n";
      $first = 0;
    }
    # Pictures, then links.
    $line =~ s{!\[([^\]]*)\]\((?:docs/|\.\./)?(images/[^)]+)\)}{'<img src="' . $2 . '" alt="' . ($1 =~ s/"/&quot;/gr) . '"/>'}ge;
    $line =~ s{(?<!!)\[([^\]]*)\]\(([^)\s]+)\)}{link_of($1, $2, $folder, $page)}ge;
    $line =~ s{^\| (E\d+) \|}{| <a id="$1"></a>$1 |} if $page eq 'equations';
    # Outside of code, no word is a command or a tag of Doxygen's.
    my @parts = split /(`[^`]*`|<\/?(?:img|a)\b[^>]*>)/, $line;
    my $inside = 0;
    for (@parts) {
      $inside = 1 if /^<a /;
      $inside = 0 if /^<\/a>/;
      next if /^`|^<\/?(?:img|a)\b/;
      s/([\@\\])(?!ref )/\\$1/g;
      s/<(?=\w)/\\</g;
      $_ = equations($_) unless $inside || $page eq 'equations' || $line =~ /^#/;
    }
    $text .= join '', @parts;
  }
  spew("$stage/pages/$page.md", $text);
}

# The name of a page. Pages of results may be named as pages of docs/ are.
sub page_of {
  my ($path) = @_;
  return 'mainpage' if $path eq 'README.md';
  return ($path =~ m{^docs/(results|reference)/} ? "$1-" : '') . basename($path, '.md');
}

# A link of a page: to a page or heading, to the web, or to a file, which is copied.
sub link_of {
  my ($words, $target, $folder, $page) = @_;
  $words =~ s{^(?:docs/)?(?:(?:results|reference)/)?([\w-]+)\.md$}{$1};
  return "[$words]($target)" if $target =~ m{^https?://};
  my ($path, $heading) = $target =~ /^([^#]*)(?:#(.*))?$/;
  return "[$words](\@ref $page-$heading)" if $path eq '';
  my @parts;
  for (split m{/}, "$folder$path") { if ($_ eq '..') { pop @parts } else { push @parts, $_ } }
  my $full = join '/', @parts;
  die "$page: $target does not exist\n" unless -e $full;
  if ($full =~ m{^(?:docs/(?:(?:results|reference)/)?[\w-]+|README)\.md$}) {
    my $name = page_of($full);
    return $name eq 'mainpage' ? "[$words](index.html)" : "[$words](\@ref $name" . ($heading ? "-$heading" : '') . ')';
  }
  return $words =~ /`/ ? $words : "`$words`" if -d $full;
  my $copy = "$full.txt";
  make_path("$stage/files/" . dirname $full);
  copy($full, "$stage/files/$copy") or die "$full: $!\n";
  return qq{<a href="files/$copy">$words</a>};
}
