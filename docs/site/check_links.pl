#!/usr/bin/env perl
# SPDX-License-Identifier: BSD-3-Clause
# Fails if a page of the site in FOLDER links to a file, heading or picture that is not there.
use strict;
use warnings;
use File::Basename;

my $folder = shift or die "usage: check_links.pl FOLDER\n";
chdir $folder or die "$folder: $!\n";
my (%anchors, $links, $failed);
sub slurp { my ($path) = @_; open(my $in, '<', $path) or die "$path: $!\n"; local $/; return <$in> }
sub anchors_of {
  my ($path) = @_;
  $anchors{$path} //= { map { $_ => 1 } slurp($path) =~ /\b(?:id|name)="([^"]*)"/g };
  return $anchors{$path};
}

for my $page (glob '*.html') {
  for (slurp($page) =~ /\b(?:href|src)="([^"]*)"/g) {
    next if m{^(?:https?:|javascript:|mailto:|data:)} || $_ eq '#';
    ++$links;
    my ($path, $anchor) = /^([^#?]*)(?:\?[^#]*)?(?:#(.*))?$/;
    $path = $page if $path eq '';
    if (!-e $path) { print STDERR "$page: $_ leads nowhere\n"; $failed = 1 }
    elsif (defined $anchor && $path =~ /\.html$/ && !anchors_of($path)->{$anchor}) {
      print STDERR "$page: $path has no #$anchor\n";
      $failed = 1;
    }
  }
}
die "$folder: no links, so no site\n" unless $links;
print "$links links\n";
exit($failed ? 1 : 0);
