#!/usr/bin/env perl
# SPDX-License-Identifier: BSD-3-Clause
# Fails if, below ROOT,
# - a type of a module is defined twice under one name, in headers or in sources outside unnamed namespaces;
# - a header of a module is neither listed in its CMakeLists.txt, as public or shared, nor named _internal, or both; a public
#   header includes one that is not public; a shared one includes an _internal one; or one is included outside its module, but for those in %lent (tests may use all);
# - a header of the signal path, public or shared, has a std::function;
# - std::filesystem is asked about a path by a function that throws what is no Error, outside modules/files;
# - a file does not begin with its licence (SPDX);
# - a file of modules/ or apps/ has more than 300 lines beside that, or a function more than 60;
# - a comment of modules/, apps/ or tests/ opens without a noun or a verb (docs/CONTRIBUTING.md);
# - an exception listed below is used by no file.
# It relies on clang-format: what begins and ends in one column belongs together.
#
#   tests/layers/check_code.pl ROOT [LINES-OF-A-FILE LINES-OF-A-FUNCTION]
use strict;
use warnings;
use File::Find;

# Internal headers, or all of a module, and who else may include them, separated by blanks.
my %lent = (
  'hdf/*' => 'tiles store',                          # both read and write HDF5 files
  'view/*' => 'viewer',                              # the viewer is built from the parts of still pictures
  'view/line_chart_internal.hpp' => 'apps',          # charts of sweeps and of the thesis
  'view/colour_maps_internal.hpp' => 'apps',         # the tool lists the maps
  'sampling/gate_surfels_internal.hpp' => 'viewer',  # the viewer explains why a surfel is not seen
  'sampling/hit_rule_internal.hpp' => 'viewer',      #
  'sonar/element_kernels_internal.hpp' => 'beamforming',
);
my %signal_path = map { $_ => 1 } qw(sonar sampling acoustics beamforming returns simulate survey);
my %long_file = ('apps/tool/survey/verb_survey.cpp' => 'still to be divided');  # path => why it may be longer
my %long_function = ();  # "path: first line" => why it may be longer
my $opener = qr{^\s*//[/!]?<?\s*(What|Of|The same|As|By|Those|That|Whether) |///< (of|as|by|to|from) };

@ARGV or die "usage: check_code.pl ROOT\n";
my ($root, $file_limit, $function_limit) = (@ARGV, 300, 60);
chdir $root or die "$root: $!\n";
my $failed = 0;
sub complain { print STDERR @_, "\n"; $failed = 1 }

my (@files, %public, %listed, %defined, %used);
find({ no_chdir => 1, wanted => sub { push @files, $_ if /\.[ch]pp$/ } }, grep { -d } 'modules', 'apps');
die "no sources under $root\n" unless @files;
for my $list (glob 'modules/*/CMakeLists.txt') {
  open(my $in, '<', $list) or die "$list: $!\n";
  my ($folder) = $list =~ m{(.*)/};
  local $/;
  my $text = <$in>;
  for my $key ('HEADERS', 'SHARED') {
    next unless $text =~ /\b$key\b([^)]*?)(?:\b(?:SHARED|DEPENDS|PRIVATE_DEPENDS)\b|\))/s;
    for (split ' ', $1) { $listed{"$folder/$_"} = 1; $public{"$folder/$_"} = 1 if $key eq 'HEADERS' }
  }
}

for my $path (sort @files) {
  open(my $in, '<', $path) or die "$path: $!\n";
  my @lines = <$in>;
  $lines[0] =~ m{^// SPDX-License-Identifier: } ? shift @lines : complain("$path: must begin with its licence: // SPDX-License-Identifier: BSD-3-Clause");
  my ($module) = $path =~ m{^modules/([^/]+)/};
  my ($here) = $path =~ m{^\w+/([^/]+)/};
  my $user = $module // 'apps';
  my $internal = $path =~ /_internal\.hpp$/;
  $used{$path} = 1 if @lines > $file_limit;
  complain("$path: ", scalar(@lines), " lines, must be $file_limit at most") if @lines > $file_limit && !$long_file{$path};
  if ($module) {
    complain("$path: neither in HEADERS of its module nor named _internal.hpp") if $path =~ /\.hpp$/ && !$internal && !$listed{$path};
    complain("$path: an internal header in HEADERS of its module") if $internal && $listed{$path};
  }

  my ($namespace, @start) = ('');  # of the definition at column 0, and within a class at column 2
  my $in_type = 0;
  for my $i (0 .. $#lines) {
    local $_ = $lines[$i];
    if (m{^#include "((?:([a-z_]+)/)?(?:[a-z_0-9]+/)*[a-z_0-9]+_internal\.hpp)"}) {
      my ($header, $other) = ($1, $2 // $here);
      complain("$path: a public header includes $header") if $listed{$path};
      $used{"$_ $user"} = 1 for $header, "$other/*";
      complain("$path: includes $header, which is internal to $other")
        unless $path =~ m{^\w+/$other/} || grep { $user eq $_ } split(' ', ($lent{$header} // '') . ' ' . ($lent{"$other/*"} // ''));
    }
    if ($public{$path} && m{^#include "((?:[a-z_0-9]+/)+[a-z_0-9]+\.hpp)"} && $1 !~ /_internal/) {
      complain("$path: a public header includes $1, which is not installed") unless $public{"modules/$1"};
    }
    complain("$path:", $i + 2, ": std::function in a header of the signal path, must be an abstract class")
      if /std::function\b/ && $listed{$path} && $signal_path{$module};
    while ($path !~ m{^modules/files/} && /\b(?:fs|filesystem)::(exists|is_directory|is_regular_file|file_size|canonical)(\((?:[^()]++|(?2))*\))/g) {
      my ($call, $given) = ($1, $2);
      complain("$path:", $i + 2, ": std::filesystem::$call throws what is no Error, must be asked by files/path_status.hpp")
        unless $given =~ /, \w+\)+$/ || $given eq '(status)';
    }
    if (/^namespace (\S* ?)\{$/) { $namespace .= '::' . ($1 =~ s/ $//r || 'unnamed') }
    if (m{^\}  // namespace}) { $namespace =~ s/^(.*)::(unnamed|.+?)$/$1/ }
    if ($module && $namespace !~ /unnamed/ && /^(?:struct|class|enum(?: class)?|union) ([\w:<> ]*?)(?: final)?(?: : [^{]*)? \{/) {
      my $name = "${namespace}::$1";
      complain("$path: $1 is defined in $defined{$name} too") if $defined{$name};
      $defined{$name} = $path;
    }
    # Functions: from the last line that began in their column to the brace that closes there.
    for my $column (0, 2) {
      next if $column == 2 && !$in_type;
      my $indent = ' ' x $column;
      if (/^$indent\}$/ && defined $start[$column]) {
        my $length = $i - $start[$column] + 1;
        my $first = $lines[$start[$column]] =~ s/^\s+|\s+$//gr;
        $used{"$path: $first"} = 1 if $length > $function_limit;
        complain("$path:", $start[$column] + 2, ": function of $length lines, must be $function_limit at most: $first")
          if $length > $function_limit && !$long_function{"$path: $first"};
      }
      $start[$column] = $i if /^$indent[\w~]/ && !/^(?:namespace|#)/;
    }
    $in_type = 1 if /^(?:struct|class|union) .*\{$/;
    $in_type = 0 if /^\};?/;
  }
}

find({ no_chdir => 1, wanted => sub { push @files, $_ if /\.[ch]pp$/ && !m{/planted/} } }, grep { -d } 'tests');
for my $path (sort @files) {
  open(my $in, '<', $path) or die "$path: $!\n";
  my $before = '';
  while (my $line = <$in>) {
    my $goes_on = $line =~ m{^\s*//} && $before =~ m{//};
    complain("$path:$.: a comment that opens with '", $1 // $2, "', must open with a noun or a verb")
      if !$goes_on && $line =~ $opener;
    $before = $line;
  }
}

for my $header (sort keys %lent) {
  next unless -d 'modules/' . $header =~ s{/.*}{}r;
  for my $user (split ' ', $lent{$header}) {
    complain("modules/$header is lent to $user, which does not include it") unless $used{"$header $user"};
  }
}
for my $long (grep { !$used{$_} } sort(keys %long_file, keys %long_function)) {
  complain("$long may be longer, and is not") if -d $long =~ s{^(\w+/\w+)/.*}{$1}r;
}
exit $failed;
