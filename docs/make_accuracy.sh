#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Measures error against run time on this machine and writes docs/results/accuracy.md with its pictures. The numbers are only
# meaningful on an otherwise idle machine.
#   docs/make_accuracy.sh [build/release/bin/insonify] [options of `insonify accuracy`, e.g. --full | --from RUN]
set -euo pipefail
cd "$(dirname "$0")/.."
tool=${1:-build/release/bin/insonify}
[[ $# -eq 0 ]] || shift

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [[ "${1:-}" == --from ]]; then    # an earlier run
  ln -s "$(realpath "$2")" "$work/run"
  shift 2
else
  "$tool" accuracy -q -o "$work/run" "$@" >/dev/null
fi
mkdir -p docs/images/accuracy
for picture in "$work"/run/*.png; do
  [[ $(stat -c %s "$picture") -lt 150000 ]] || { echo "make_accuracy.sh: $picture is larger than 150 kB" >&2; exit 1; }
  cp "$picture" docs/images/accuracy/
done
cp "$work/run/sweep.csv" "$work/run/sampling.csv" docs/images/accuracy/

# rows CSV CONDITION FORMAT: one line per row of the CSV, columns by name, in awk.
rows() {
  awk -F, -v OFS=' | ' 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    function c(name) { return $(at[name]) }
    function s(x) { return x >= 100 ? sprintf("%.0f s", x) : x >= 1 ? sprintf("%.3g s", x) : sprintf("%.3g ms", 1000 * x) }
    function span() { return s(c("seconds")) " (" s(c("seconds_min")) " to " s(c("seconds_max")) ")" }
    '"$2 { $3 }" "$1"
}
sweep=$work/run/sweep.csv
field() { sed -n "s/^ *\"$1\": \"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}\$/\1/p" "$work/run/manifest.json" | head -1; }

# ratios SCATTERERS: gridded at 1e-6 against direct and windowed-direct, from the series over scatterers.
ratios() {
  awk -F, -v n="$1" 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    $(at["sweep"]) == "scatterers" && $(at["scatterers"]) == n {
      m = $(at["method"]); t = $(at["tolerance"]) + 0
      if (m == "direct" || t == 1e-6) { med[m] = $(at["seconds"]); low[m] = $(at["seconds_min"]); high[m] = $(at["seconds_max"])
        error[m] = $(at["error"]); part[m] = $(at["timed_scatterers"]) } }
    END { if (!("gridded" in med)) exit
      for (m in med) if (m != "gridded")
        printf "| %d | %s (timed on %d) | %.3g s | %.1f ms, error %s | **%s x** | %s to %s |\n", n, m, part[m], med[m], \
          1000 * med["gridded"], error["gridded"], r(med[m] / med["gridded"]), r(low[m] / high["gridded"]), r(high[m] / low["gridded"]) }
    function r(x) { return x >= 100 ? sprintf("%.0f", x) : x >= 1 ? sprintf("%.3g", x) : sprintf("%.2f", x) }' "$sweep"
}

{
cat <<TEXT
# Error against run time

Made by [docs/make_accuracy.sh](../make_accuracy.sh) from one run of \`insonify accuracy${*:+ $*}\`; do not edit. Raw numbers:
[sweep.csv](../images/accuracy/sweep.csv), [sampling.csv](../images/accuracy/sampling.csv).

$(field cpu), $(field cores) cores, load average $(field load_average) when it started; $(field compiler), \`$(field flags)\`; commit $(field commit), version
$(field insonify_version), $(field threads) threads, seed $(field seed). Absolute times depend on the machine and its load; ratios are more robust.

This page is about synthesis and sampling. What a ping leaves out as not needed, within \`--accuracy-db\`, is in [plan.md](plan.md).

## How it is measured

- **Error**: relative L2 norm of the difference from the direct sum in double, over all bins of \`checked_beams\` evenly spaced beams (including both ends of the fan)
  and all echoes. **Local error**: the same for the worst eighth of the range axis, relative to that eighth's own level.
- **Error of the reference** (rows \`direct\`): against the same sum in long double with compensated summation, on at most 2000 echoes, 4 beams and 64
  bins. It is $(awk -F, '$1 == "direct" && $9 > w { w = $9 } END { printf "%.1e", w }' "$sweep") at most, so smaller errors cannot be resolved.
- **Time**: wall time, median of five runs after a warm-up, minimum and maximum in brackets; at least two runs of slow methods (column \`repeats\`). Plans
  (FFTW: ESTIMATE) are made once per head and listed separately in \`plan_seconds\`. Direct sums are timed on \`timed_scatterers\` evenly spaced echoes and
  scaled linearly, since their cost is the same for every echo.
- **Echoes**: complex normal amplitudes, uniform over fan and gate; 600 kHz, 30 kHz band, bins of 0.44 c/2B unless stated otherwise.

## Methods

| method | what it is |
|---|---|
| gridded | the narrow band: pulses gridded with a spreading kernel (E60), one FFT per bin |
| direct | the plain sum over echoes, beams, elements and all bins: the reference, not optimised |
| windowed-direct | an optimised direct sum: pulses truncated at the tolerance, the pattern from a table. The relevant competitor |
| spectrum | sum of spectra, one FFT per beam (timed on 4 beams, scaled) |
| nearest-bin | delays rounded to bins, carrier phase kept: the error cannot be reduced |
| pattern-cut | pattern truncated at K null widths: the error falls slowly with K |

![Error against run time](../images/accuracy/work_precision.png)

| method | asked for | kernel | error | local error | level error (60 dB window) | time | peak memory |
|---|---|---|---|---|---|---|---|
TEXT
rows "$sweep" 'c("sweep") == "work-precision"' 'print "| " c("method") (c("parameter") > 0 ? " K = " c("parameter") : "") ", " c("precision"), (c("tolerance") > 0 ? c("tolerance") : ""), (c("kernel_width") > 0 ? c("kernel_width") : ""), c("error"), c("local_error"), (c("method") ~ /direct$|spectrum/ && c("tolerance") == 0 ? "" : c("max_level_db") " dB"), span(), sprintf("%.0f MiB |", c("peak_mib"))'
cat <<TEXT

## How much faster

The gridded method at a tolerance of 1e-6 compared with the direct sums; 512 beams, 2000 bins. Last column: range of the ratio over fastest and slowest runs. The required
ratio to direct is 150 at 50 000 echoes and 400 at 500 000 (\`--full\`).

| echoes | against | its time | gridded | ratio | spread |
|---|---|---|---|---|---|
TEXT
for n in 1 10 100 1000 10000 50000 500000; do ratios "$n"; done
cat <<TEXT

$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
  $(at["sweep"]) == "scaling" { t[$(at["timed_scatterers"]) == $(at["scatterers"])] = $(at["seconds"]); part = $(at["timed_scatterers"]); n = $(at["scatterers"]) < part ? n : $(at["scatterers"]) }
  $(at["sweep"]) == "scaling" && $(at["timed_scatterers"]) < $(at["scatterers"]) { k = $(at["timed_scatterers"]) }
  END { if (1 in t) printf "Check of the linear scaling: direct with %d echoes: %.3g s scaled from %d, %.3g s measured.", n, t[0], k, t[1] }' "$sweep")

**Where it is slower**: up to some hundred echoes the transforms of all touched bins would cost more than the sum itself, so the default sums directly with the exact
pattern. The rows with ratios below 1 show the remaining overhead. Much of
the ratio to direct is due to direct itself, which evaluates every pulse in every bin and the pattern element by element.

![Run time against scatterers](../images/accuracy/crossover.png)

| threads | tolerance | time |
|---|---|---|
TEXT
rows "$sweep" 'c("sweep") == "threads"' 'print "| " c("threads"), c("tolerance"), span() " |"'
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
  $(at["sweep"]) == "threads" { t[$(at["tolerance"]), $(at["threads"])] = $(at["seconds"]); seen[$(at["tolerance"])] = 1 }
  END { printf "\n"; for (k in seen) if ((k, 2) in t) printf "Speed-up by the second core: %.2f x at %s.  ", t[k, 1] / t[k, 2], k; printf "\n" }' "$sweep"
cat <<TEXT

## Does the error stay within the tolerance?

Maximum over all images of the sweep: 1 to $(awk -F, '$3 + 0 > m { m = $3 + 0 } END { printf "%d", m }' "$sweep") echoes, 1 to $(awk -F, '$4 + 0 > m { m = $4 + 0 } END { printf "%d", m }' "$sweep") beams, prime numbers of bins, bands of 3 to 300 kHz, absorption of order 0 to 2, dynamic ranges of 0
to 150 dB.

| tolerance | images | worst error | worst error / tolerance | worst local error | worst local error / tolerance |
|---|---|---|---|---|---|
TEXT
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
  $(at["method"]) == "gridded" { t = $(at["tolerance"]); ++n[t]; e = $(at["error"]); l = $(at["local_error"]); if (e > w[t]) w[t] = e; if (l > v[t]) v[t] = l }
  END { for (t in n) printf "%s| %s | %d | %s | %.2f | %s | %.2f |\n", t, t, n[t], w[t], w[t] / t, v[t], v[t] / t }' "$sweep" | sort -gr | sed 's/^[^|]*//'
cat <<TEXT

![Promise](../images/accuracy/promise.png)

The error is local: strong near echoes do not degrade weak far ones, as they do with a transform over the whole range axis.

![Local error](../images/accuracy/local_error.png)

Absorption that varies over the band (100 kHz about 600 kHz, 60 dB over the gate): error if it is modelled as constant (order 0) or with
its slope only (order 1).

| order of the absorption | order modelled | error |
|---|---|---|
TEXT
rows "$sweep" 'c("method") == "absorption-order"' 'print "| " c("absorption_order"), c("parameter"), c("error") " |"'
cat <<TEXT

## Engines

Every engine on tasks in which they differ: 1000 echoes, 48 beams of 1.5 degrees, 256 bins, unless the name says otherwise. **Error**: against the referee of the engine's own
model on the same echoes (gridded, direct, spectrum: the direct sum; true-delays, element-exact: element-exact at 1e-12; incoherent: the sum of |P|^2 over echoes, E65). **Model**: what the
narrow band leaves out, against the image with true delays, beside the **bound** by which the plan decides. Engines that the plan takes are bold; their last column is their time over that of the
fastest engine of the same model that holds the tolerance. The model is not a matter of time: true delays are taken where twice the bound exceeds the share of \`--accuracy-db\`
that the plan leaves to each effect (0.0044 of 0.1 dB), whatever the tolerance. Element-exact at 1e-12 is the referee itself.

![Engines](../images/accuracy/engines.png)

| task | engine | tolerance | error | model | bound | time | over the fastest |
|---|---|---|---|---|---|---|---|
TEXT
exceeded() {  # one sentence
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    $(at["sweep"]) == "engines" && $(at["tolerance"]) > 0 && $(at["error"]) + 0 > $(at["tolerance"]) + 0 {
      list = list (list ? "; " : "") $(at["method"]) " at " $(at["tolerance"]) ", " $(at["task"]) ": " $(at["error"]) }
    END { print list ? "**Tolerances that are exceeded**: " list "." : "No tolerance is exceeded." }' "$sweep"
}
# The sweep with one column more: the time of an engine that the plan takes, over that of the fastest engine of its model
# that holds the tolerance.
awk -F, 'function c(name) { return $(at[name]) }
  FNR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; if (NR > 1) print $0 ",slower"; next }
  { t = c("tolerance") + 0; holds = c("sweep") == "engines" && c("refused") == "" && (t == 0 || c("error") + 0 <= t)
    model = c("task") "," (c("model_bound") + 0 > 0 ? "narrow band" : c("method") == "incoherent" ? "power" : "true delays") }
  NR == FNR { if (holds && (!((model, t) in least) || c("seconds") + 0 < least[model, t])) least[model, t] = c("seconds") + 0; next }
  { fastest = least[model, t]; if (((model, 0) in least) && least[model, 0] < fastest) fastest = least[model, 0]
    print $0 "," (holds && c("planned") + 0 ? sprintf("%.2f", c("seconds") / fastest) : "") }' "$sweep" "$sweep" >"$work/chosen.csv"
slowest_choice() {  # one sentence
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    $(at["slower"]) + 0 > most { most = $(at["slower"]) + 0; which = $(at["method"]) ", " $(at["task"]) ", " $(at["tolerance"]) }
    END { printf "The plan takes at most %.2f times as long as the fastest engine of the same model that holds the tolerance (%s; 1.5 allowed).\n", most, which }' "$work/chosen.csv"
}
engine_rows() {
  rows "$work/chosen.csv" "c(\"sweep\") == \"$1\" && c(\"tolerance\") ~ /^(0|0.01|0.0001|1e-05|1e-08)\$/" 'print "| " c("task"), (c("planned") ? "**" c("method") "**" : c("method")), (c("tolerance") > 0 ? c("tolerance") : ""), (c("refused") != "" ? "refused: " c("refused") : c("error")), (c("model_error") > 0 ? c("model_error") : ""), (c("model_bound") > 0 ? c("model_bound") : ""), (c("refused") != "" ? "" : span()), c("slower") " |"'
}
engine_rows engines
printf '\n%s\n\n%s\n' "$(exceeded)" "$(slowest_choice)"
cat <<TEXT

## Where arithmetic is strained

The same, at a tolerance of 1e-4. Local error: of the eighth of the range axis that is worst, relative to its own level.

| case | engine | error | local error | holds |
|---|---|---|---|---|
TEXT
rows "$sweep" 'c("sweep") == "stability"' 't = c("tolerance") > 0 ? c("tolerance") : 1e-4; print "| " c("task"), c("method"), (c("refused") != "" ? "refused: " c("refused") : c("error")), (c("refused") != "" ? "" : c("local_error")), (c("refused") != "" ? "" : c("error") > t ? "no" : c("local_error") > t ? "in the whole image" : "yes") " |"'
cat <<TEXT

## Sampling

Error of the mean level of a flat bottom, without speckle, for a given number of rays or surfels. With independent random rays it falls with the root of their number.
The default rays are jittered within equal intervals of elevation and converge faster. The accuracy of surfels follows the density of the cloud; splitting them corrects the speckle, not the
mean.

![Sampling error](../images/accuracy/sampling.png)

| sampling | rays per beam, surfels per m2, or scatterers per cell | scatterers per beam | error | level |
|---|---|---|---|---|
TEXT
rows "$work/run/sampling.csv" 'NR > 1' 'print "| " c("sampling"), c("parameter") + 0, sprintf("%.0f", c("scatterers_per_beam")), c("error"), c("error_db") " dB |"'
cat <<TEXT

## True delays

Method \`true-delays\` (E68) against element-exact at 1e-7, made by \`true_delays_accuracy\`: relative L2 error of 24 beams for 100 echoes within ten
degrees of the direction, over 60 bins to either side of the range; processor time of the image on one thread for 200 000 echoes over half the range, median of seven,
next to that of the narrow-band image at 1e-3. The promise holds against element-exact, whose image is that of delays of every element to
echo and focus: a line array of point elements, Gaussian pulses, echoes at rest or moving, tolerances from 1e-5. Sweeps are held to 1e-2 only.
Rows of a rough field: all surfels seen of a bed that is rough at its own spacing of 2 cm, unsplit, from 2 m above; errors for 3000 of them. So few echoes leave
nearly all of the cost in transforms. A default ping splits them, to millions: of the built-in harbour, 27 million echoes at 0.5 to 40 m, oculus-m750d, it takes 1.3 times the processor
time of the ping with \`--method gridded\`. Tables are made once for each head; they cost the first image of a head some 20 to 100 ms more.

TEXT
"$(dirname "$tool")/true_delays_accuracy"
} >"$work/accuracy.md"
# Engines have a page of their own.
{
  printf '# Engines: error against run time\n\nMade by [docs/make_accuracy.sh](../make_accuracy.sh) with [accuracy.md](accuracy.md), from the same run; do not edit. All tolerances: [sweep.csv](../images/accuracy/sweep.csv).\n\n'
  sed -n '/^## Engines$/,/^## Sampling$/p' "$work/accuracy.md" | sed '$d'
} | sed '$d' >docs/results/engines.md
sed '/^## Engines$/,/^## Sampling$/{/^## Sampling$/!d}' "$work/accuracy.md" >docs/results/accuracy.md
echo "docs/results/accuracy.md and engines.md written"
