#!/usr/bin/env perl
# SPDX-License-Identifier: BSD-3-Clause
# Runs the tests of build/dev whose inputs differ from those with which they last passed.
#
#   tests/run_changed.pl [--all] [--full] [OPTIONS OF CTEST]
#
# Without --full, tests with the label `long` are left out.
#
# Inputs of a test are its command and properties, the files that its command names, those of its REQUIRED_FILES
# (tests/CMakeLists.txt; a folder stands for all below it), and the installed packages. A test without REQUIRED_FILES is
# always run. What passes or fails is recorded in build/dev/passed_tests.txt at once: an interrupted run counts as far as
# it came.
use strict;
use warnings;
use Digest::SHA qw(sha1_hex);
use File::Find;
use FindBin;
use JSON::PP;

chdir "$FindBin::Bin/.." or die "$0: $!\n";
my ($all, $full) = map { my $flag = $_; scalar grep { $_ eq $flag } @ARGV } "--all", "--full";
@ARGV = grep { $_ ne "--all" && $_ ne "--full" } @ARGV;
my @labels = $full ? () : ("-LE", '^long$');
my $record = "build/dev/passed_tests.txt";

# Hash of a file, or of all files below a folder.
my %hashes;
sub hash_of {
  my ($path) = @_;
  return $hashes{$path} //= do {
    my @files;
    find({no_chdir => 1, wanted => sub { push @files, $_ if -f }}, $path);
    sha1_hex(map { "$_\n" . Digest::SHA->new->addfile($_, "b")->hexdigest } sort @files);
  };
}

# Hash of all inputs of a test; nothing if they are unknown.
my $packages = -e "/var/lib/dpkg/status" ? hash_of("/var/lib/dpkg/status") : "";
sub inputs_of {
  my ($test) = @_;
  my %properties = map { $_->{name} => $_->{value} } @{$test->{properties}};
  return unless $test->{command} && $properties{REQUIRED_FILES};
  my $text = JSON::PP->new->canonical->encode([$test->{command}, \%properties]);
  my @files = ((grep { -f } @{$test->{command}}), @{$properties{REQUIRED_FILES}});
  return sha1_hex($packages, $text, map { hash_of($_) } @files);
}

# Inputs with which each test passed; "-" if it failed since.
my %passed;
if (open(my $in, "<", $record)) {
  while (<$in>) { $passed{$2} = $1 if /^(\S+) (\S+)$/ }
}
open(my $out, ">", $record) or die "$record: $!\n";
$out->autoflush;
print $out map { "$passed{$_} $_\n" } sort keys %passed;

my (%inputs, @unchanged, $changed);
open(my $list, "-|", "ctest", "--test-dir", "build/dev", "--show-only=json-v1", @labels) or die "ctest: $!\n";
my $listing = join "", <$list>;
close $list;
for my $test (@{decode_json($listing)->{tests}}) {
  my $name = $test->{name};
  my $hash = $inputs{$name} = inputs_of($test);
  !$all && $hash && $hash eq ($passed{$name} // "") ? push(@unchanged, $name) : ++$changed;
}
my $skipped = @unchanged . " tests not run: nothing has changed since they passed (--all runs them)\n";
if (!$changed) { print $skipped; exit 0 }

chomp(my $jobs = `nproc`);
my @exclude = @unchanged ? ("-E", "^(" . join("|", map { quotemeta } @unchanged) . ')$') : ();
open(my $ctest, "-|", "ctest", "--preset", "dev", "-j", $jobs, @labels, @exclude, @ARGV) or die "ctest: $!\n";
$| = 1;
while (<$ctest>) {
  print;
  next unless m{^ *\d+/\d+ Test +#\d+: (\S+) \.*[* ]*(\w+)};
  my $hash = $2 eq "Passed" && $inputs{$1} || "-";
  print $out "$hash $1\n";
}
close $ctest;
my $code = $? >> 8;
print $skipped if @unchanged;
exit $code;
