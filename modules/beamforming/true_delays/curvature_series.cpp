// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/Dense>

#include "beamforming/true_delays/curvature_samples_internal.hpp"
#include "beamforming/true_delays/curvature_series_internal.hpp"
#include "beamforming/true_delays/node_functions_internal.hpp"

namespace insonify {
namespace {

constexpr double term_share = 0.4;   // of the tolerance, for the terms left out
constexpr double band_share = 0.35;  // of the tolerance, for the powers of frequency left out
constexpr double first_share = 0.1;  // of what terms may leave, for elimination before singular values
constexpr double hardly = 1e-5;      // weight of frequencies at which a row of harmonics lies off the array

/// values = along x across, with few terms: columns of along have a mean square of 1 and are orthogonal.
struct Factors {
  Eigen::MatrixXcd along, across;

  Factors(const CurvatureSamples& samples, double tolerance) {
    // Eliminates rows one after another, the one with most left first.
    const Eigen::Map<const Eigen::RowVectorXd> weight(samples.weight.data(),
                                                      static_cast<Eigen::Index>(samples.weight.size()));
    CurvatureSamples::RowMatrix a = samples.value * weight.asDiagonal();
    const double all = a.squaredNorm(), enough = std::pow(first_share * tolerance, 2) * all;
    std::vector<Eigen::Index> chosen;
    Eigen::MatrixXcd found(a.rows(), std::min(a.rows(), a.cols()));
    Eigen::VectorXd left = a.rowwise().squaredNorm();
    while (left.sum() > enough && static_cast<Eigen::Index>(chosen.size()) < found.cols()) {
      Eigen::Index worst = 0;
      left.maxCoeff(&worst);
      const Eigen::RowVectorXcd q = a.row(worst) / std::sqrt(left[worst]);
      const Eigen::VectorXcd share = a * q.adjoint();
      a.noalias() -= share * q;
      found.col(static_cast<Eigen::Index>(chosen.size())) = share;
      chosen.push_back(worst);
      left = a.rowwise().squaredNorm();
    }
    const auto n = static_cast<Eigen::Index>(chosen.size());
    Eigen::MatrixXcd some(n, n), rows(n, samples.value.cols());
    for (Eigen::Index k = 0; k < n; ++k) some.row(k) = found.row(chosen[static_cast<std::size_t>(k)]).head(n);
    for (Eigen::Index k = 0; k < n; ++k) rows.row(k) = samples.value.row(chosen[static_cast<std::size_t>(k)]);
    const Eigen::MatrixXcd terms = some.transpose().fullPivLu().solve(found.leftCols(n).transpose()).transpose();
    // Singular values of what they span.
    const Eigen::HouseholderQR<Eigen::MatrixXcd> qr(terms);
    const Eigen::MatrixXcd q = qr.householderQ() * Eigen::MatrixXcd::Identity(terms.rows(), n);
    const Eigen::MatrixXcd root = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
    const Eigen::MatrixXcd spanned = root * rows, weighed = spanned * weight.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> values(weighed * weighed.adjoint());
    Eigen::Index skipped = 0;
    for (double less = tolerance * tolerance * all - enough; skipped + 1 < n; ++skipped)
      if ((less -= std::max(values.eigenvalues()[skipped], 0.0)) < 0) break;
    const Eigen::MatrixXcd kept = values.eigenvectors().rightCols(n - skipped).rowwise().reverse();
    const double scale = std::sqrt(static_cast<double>(terms.rows()));
    along = scale * q * kept;
    across = kept.adjoint() * spanned / scale;
  }
  Eigen::Index terms() const { return along.cols(); }
};

/// The second factors by row of harmonics and power of frequency.
struct BandRows {
  std::vector<std::size_t> band;      ///< powers of each term
  std::vector<Eigen::MatrixXcd> row;  ///< factors of each term: harmonic by power

  BandRows(const TrueDelayPlan& plan, const RowFits& fits, const CurvatureSamples& samples, const Factors& factors) {
    const auto nodes = static_cast<Eigen::Index>(TrueDelayPlan::fit_nodes),
               rows = static_cast<Eigen::Index>(plan.rows()), count_y = static_cast<Eigen::Index>(samples.positions);
    const Eigen::Map<const Eigen::VectorXd> fit(plan.fit_frequency.data(), nodes);
    const Eigen::MatrixXd between = from_nodes(fit / plan.half_band, plan.node_frequency.size());
    // Find the factors of the rows of harmonics, by frequency.
    std::vector<Eigen::MatrixXcd> value(static_cast<std::size_t>(factors.terms()), Eigen::MatrixXcd(nodes, rows));
    for (Eigen::Index f = 0; f < nodes; ++f) {
      Eigen::MatrixXcd here = Eigen::MatrixXcd::Zero(factors.terms(), count_y);
      for (Eigen::Index n = 0; n < between.cols(); ++n)
        here += between(f, n) * factors.across.middleCols(n * count_y, count_y);
      const Eigen::VectorXd position = fits.position.col(f) / RowPositions(plan, fit[f]).reach;
      const Eigen::MatrixXcd at_rows =
          from_nodes(position.cwiseMax(-1.0).cwiseMin(1.0), samples.positions) * here.transpose();
      for (Eigen::Index q = 0; q < factors.terms(); ++q) value[static_cast<std::size_t>(q)].row(f) = at_rows.col(q);
    }
    fit_powers(plan, fits, value);
  }

 private:
  void fit_powers(const TrueDelayPlan& plan, const RowFits& fits, const std::vector<Eigen::MatrixXcd>& value) {
    const auto powers = static_cast<Eigen::Index>(TrueDelayPlan::most_powers);
    std::vector<Eigen::MatrixXcd> share(value.size(), Eigen::MatrixXcd(powers, fits.position.rows()));
    Eigen::MatrixXd left = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(value.size()), powers + 1);
    for (std::size_t t = 0; t < value.size(); ++t)
      for (std::size_t k = 0; k < fits.row.size(); ++k) {
        const RowFits::Row& fit = fits.row[k];
        const auto here = static_cast<Eigen::Index>(k);
        const Eigen::VectorXcd weighed = fit.weight.asDiagonal() * value[t].col(here);
        share[t].col(here).noalias() = fit.across * weighed;
        double rest = weighed.squaredNorm();
        for (Eigen::Index s = 0; s <= powers; ++s) {
          left(static_cast<Eigen::Index>(t), s) += fit.counts * std::max(rest, 0.0);
          if (s < powers) rest -= std::norm(share[t](s, here));
        }
      }
    const double enough = std::pow(band_share * plan.tolerance, 2) * fits.all / static_cast<double>(value.size());
    for (std::size_t t = 0; t < value.size(); ++t) {
      Eigen::Index n = 1;
      while (n < powers && left(static_cast<Eigen::Index>(t), n) > enough) ++n;
      if (t > 0) n = std::min(n, static_cast<Eigen::Index>(band.back()));
      band.push_back(static_cast<std::size_t>(n));
      row.emplace_back(fits.position.rows(), n);
      for (std::size_t k = 0; k < fits.row.size(); ++k)
        row.back().row(static_cast<Eigen::Index>(k)) = fits.row[k]
                                                           .root.topLeftCorner(n, n)
                                                           .triangularView<Eigen::Upper>()
                                                           .solve(share[t].col(static_cast<Eigen::Index>(k)).head(n))
                                                           .transpose();
    }
  }
};

/// Factors for kernels::RowMix: terms to powers of frequency, or back.
void fill_rows(const TrueDelayPlan& plan, const BandRows& from, bool echoes, CurvatureSeries& series) {
  const std::size_t terms = series.terms, most_band = series.band[0];
  const std::size_t outs = echoes ? most_band : terms, ins = echoes ? terms : most_band;
  series.ins.assign(outs, 0);
  series.most_ins = ins;
  for (std::size_t q = 0; q < terms; ++q)
    for (std::size_t s = 0; s < series.band[q]; ++s) ++series.ins[echoes ? s : q];
  series.rows.assign(series.stride / 8 * outs * ins * 16, 0);
  for (std::size_t k = 0; k < plan.rows(); ++k) {
    const std::size_t g = (k + plan.grid - plan.most) % plan.grid;
    const double sign = (k + plan.most) % 2 == 0 ? 1 : -1;
    for (std::size_t q = 0; q < terms; ++q)
      for (std::size_t s = 0; s < series.band[q]; ++s) {
        const std::complex<double> value =
            sign * from.row[q](static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(s));
        const std::size_t out = echoes ? s : q, in = echoes ? q : s;
        float* to = series.rows.data() + ((g / 8 * outs + out) * ins + in) * 16 + g % 8;
        to[0] = static_cast<float>(value.real());
        to[8] = static_cast<float>(echoes ? value.imag() : -value.imag());
      }
  }
}

/// Along the steps of the grid and time: polynomials of time, which undo the kernel between harmonics too.
void fill_along(const TrueDelayPlan& plan, const CurvatureSamples& samples, const Factors& factors, double widest,
                bool echoes, CurvatureSeries& series) {
  const std::size_t count_u = samples.u.size(), count_r = samples.r.size();
  Eigen::VectorXd x(static_cast<Eigen::Index>(plan.grid));
  for (std::size_t g = 0; g < plan.grid; ++g) {
    const double u = (static_cast<double>(g) / static_cast<double>(plan.grid) - 0.5) * plan.period;
    x[static_cast<Eigen::Index>(g)] = std::clamp(u / widest, -1.01, 1.01);
  }
  const Eigen::MatrixXd across = from_nodes(x, count_u), powers = powers_from_nodes(count_r);
  series.along.assign(series.terms * series.powers * 2 * series.stride, 0);
  float* to = series.along.data();
  for (std::size_t q = 0; q < series.terms; ++q) {
    const Eigen::Map<const Eigen::MatrixXcd> node(factors.along.col(static_cast<Eigen::Index>(q)).data(), count_r,
                                                  count_u);
    const Eigen::MatrixXcd by_power = powers * node;
    const Eigen::MatrixXd re = across * by_power.real().transpose(), im = across * by_power.imag().transpose();
    for (std::size_t k = 0; k < series.powers; ++k, to += 2 * series.stride)
      for (std::size_t g = 0; g < plan.grid; ++g) {
        if (std::abs(x[static_cast<Eigen::Index>(g)]) > 1) continue;
        to[g] = static_cast<float>(plan.position_factor[g] * re(g, k));
        to[series.stride + g] = static_cast<float>((echoes ? 1 : -1) * plan.position_factor[g] * im(g, k));
      }
  }
}

}  // namespace

RowFits::RowFits(const TrueDelayPlan& plan) {
  const auto nodes = static_cast<Eigen::Index>(TrueDelayPlan::fit_nodes), rows = static_cast<Eigen::Index>(plan.rows()),
             powers = static_cast<Eigen::Index>(TrueDelayPlan::most_powers);
  position.resize(rows, nodes);
  Eigen::ArrayXXd within(rows, nodes);  // 1: near the array
  for (Eigen::Index f = 0; f < nodes; ++f) {
    const RowPositions on_array(plan, plan.fit_frequency[static_cast<std::size_t>(f)]);
    const auto most = static_cast<double>(plan.most);
    position.col(f) = on_array.row * Eigen::VectorXd::LinSpaced(rows, -most, most);
    within.col(f) = (position.col(f).array().abs() <= on_array.reach).cast<double>();
  }
  const Eigen::Map<const Eigen::VectorXd> node_weight(plan.fit_weight.data(), nodes);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> power(
      plan.fit_power.data(), nodes, powers);
  for (Eigen::Index k = 0; k < rows; ++k) {
    Row fit;
    // Frequencies at which the row lies off the array hardly count beside those at which it does not.
    const Eigen::ArrayXd covered = within.row(k).transpose() * node_weight.array();
    fit.weight = covered + (1 - within.row(k).transpose()) * node_weight.array().min(hardly * covered.maxCoeff());
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(fit.weight.asDiagonal() * power);
    fit.across = (qr.householderQ() * Eigen::MatrixXd::Identity(nodes, powers)).transpose();
    fit.root = qr.matrixQR().topRows(powers);
    for (Eigen::Index f = 0; f < nodes; ++f)
      fit.counts = std::max(fit.counts, node_weight[f] * CurvatureSamples::shading_at(plan, position(k, f)));
    fit.counts *= fit.counts / node_weight.squaredNorm();
    all += fit.counts * fit.weight.squaredNorm();
    row.push_back(std::move(fit));
  }
}

CurvatureSeries curvature_series(const TrueDelayPlan& plan, const RowFits& fits, bool echoes, double first,
                                 double last) {
  const auto guard = static_cast<double>(plan.guard), bins = static_cast<double>(plan.axis.bins);
  CurvatureSpan span;
  span.echoes = echoes;
  span.first_time = echoes ? plan.axis.time_of(first) - plan.reach : plan.axis.time_of(std::max(first - guard, 0.0));
  span.last_time = echoes ? plan.axis.time_of(last) + plan.reach : plan.axis.time_of(std::min(last + guard, bins));
  span.widest = 0;
  for (const double u : plan.u_beam) span.widest = std::max(span.widest, std::abs(u));
  if (echoes) span.widest = plan.widest;
  span.widest += 5 * plan.period / static_cast<double>(plan.grid);
  span.mean_range = std::max(0.25 * plan.medium.sound_speed * (plan.axis.time_of(first) + plan.axis.time_of(last)),
                             0.45 * plan.aperture);
  span.mean_u = std::min(plan.widest, 1.0) / std::sqrt(2.0);
  const CurvatureSamples samples(plan, span);
  const Factors factors(samples, term_share * plan.tolerance);
  BandRows rows(plan, fits, samples, factors);

  CurvatureSeries series;
  series.terms = static_cast<std::size_t>(factors.terms());
  series.powers = samples.r.size();
  series.middle = samples.middle;
  series.half = samples.half;
  series.stride = (plan.grid + 7) / 8 * 8;
  series.band = std::move(rows.band);
  fill_rows(plan, rows, echoes, series);
  fill_along(plan, samples, factors, span.widest, echoes, series);
  return series;
}

}  // namespace insonify
