// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

namespace insonify {

/// Mean and standard deviation.
struct MeanAndDeviation {
  double mean = 0, deviation = 0;
};
/// Returns mean and standard deviation of a sample; both are 0 if it is empty.
MeanAndDeviation mean_and_deviation(const std::vector<double>& values);

/// Returns the Wasserstein-1 distance of two samples: the mean distance of their quantiles, in their unit (E121).
/// Throws Error(argument) if one is empty.
double wasserstein_1(std::vector<double> a, std::vector<double> b);

/// A Kolmogorov-Smirnov test.
struct KolmogorovSmirnov {
  double distance = 0;     ///< largest difference of the distribution functions
  double probability = 1;  ///< probability of a larger one if both samples have one distribution (asymptotic)
  std::size_t samples = 0, others = 0;
};

/// Tests two samples of independent numbers. Throws Error(argument) if one is empty.
KolmogorovSmirnov kolmogorov_smirnov(std::vector<double> a, std::vector<double> b);
/// Tests one sample against the exponential distribution of mean 1, that of the intensity of fully developed speckle.
KolmogorovSmirnov kolmogorov_smirnov_exponential(std::vector<double> sample);

/// y = offset + slope x by least squares; slope 0 if all x are equal.
struct FittedLine {
  double offset = 0, slope = 0;
};
/// Fits a line to points of equal weight.
FittedLine fit_line(const std::vector<double>& x, const std::vector<double>& y);

/// A monotone map of levels: straight lines between knots, of slope 1 beyond them.
struct LevelMap {
  std::vector<double> from, to;  ///< ascending
};

/// Returns the map that gives a sample the distribution of another: knots at 21 quantiles, 0 to 100 % (E121). Throws
/// Error(argument) if one is empty.
LevelMap level_map(std::vector<double> from, std::vector<double> to);
/// Returns the level that a map gives for `level`.
double mapped(const LevelMap& map, double level);

}  // namespace insonify
