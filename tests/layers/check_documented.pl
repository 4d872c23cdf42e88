#!/usr/bin/env perl
# SPDX-License-Identifier: BSD-3-Clause
# Fails if a type, function, or alias that a public header of ROOT/modules shows has no /// comment before it. Destructors,
# moves, deleted and defaulted functions say all by themselves. It relies on clang-format.
use strict;
use warnings;

my $root = shift or die "usage: check_documented.pl ROOT\n";
chdir $root or die "$root: $!\n";
my $failed = 0;
my @headers = grep { !/_internal\.hpp$/ } glob 'modules/*/*.hpp modules/*/*/*.hpp';
die "no headers under $root\n" unless @headers;

for my $path (@headers) {
  open(my $in, '<', $path) or die "$path: $!\n";
  my ($type, $hidden, $documented) = (0, 0, 0);
  while (my $line = <$in>) {
    my $comment = $line =~ m{^\s*///(?!<)};
    my $head = $line =~ s{//.*}{}r;
    1 while $head =~ s/<[^<>]*>//;   # arguments of templates, whose parentheses are of no function
    $head =~ s/^template\s*//;
    if ($line =~ /^(?:struct|class) .*\{$/) { ($type, $hidden) = (1, $line =~ /^class/ ? 1 : 0) }
    if ($line =~ /^ (public|protected|private):/) { $hidden = $1 ne 'public' }
    my $column = $type && $line !~ /^\w/ ? 2 : 0;
    my $indent = ' ' x $column;
    if (!($column && $hidden) && $head =~ /^$indent(?=\w)(.*)/) {
      my $words = $1;
      my $is_type = $words =~ /^(?:struct|class|enum(?: class)?|union) \w.*\{/ || $words =~ /^using \w+ =/;
      my $is_function = $words =~ /^[^=({]*\(/ && $words !~ /^(?:return|static_assert|friend|namespace|using|if|for)\b/
        && $words !~ /= (?:default|delete);/ && $words !~ /&&\) noexcept;/ && $words !~ /^[A-Z_]+\(/;
      if (($is_type || $is_function) && !$documented && $line !~ m{///<}) {
        chomp $line;
        print STDERR "$path:$.: no /// comment: ", $line =~ s/^\s+//r, "\n";
        $failed = 1;
      }
    }
    $type = 0 if $line =~ /^\};/;
    $documented = $comment || ($documented && $line =~ /^\s*(?:template|\[\[)/);
  }
}
exit $failed;
