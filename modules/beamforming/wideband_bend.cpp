#include <cmath>
#include <complex>

#include <Eigen/Dense>

#include "beamforming/wideband_bend_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Complex = std::complex<double>;
using RowMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr std::size_t nodes_of_band = WidebandPlan::band_nodes;
constexpr double share = 0.4;         // of the tolerance, for the terms left out
constexpr double node_share = 0.05;   // of the tolerance, for nodes in range
constexpr double power_share = 0.02;  // of the tolerance, for powers of frequency
constexpr double nothing = 1e-20;     // square of a part of a series that does not count

double chebyshev_node(std::size_t j, std::size_t n) {
  return std::cos(pi * (static_cast<double>(j) + 0.5) / static_cast<double>(n));
}

/// values(x) = matrix x values(nodes): by Chebyshev polynomials T of degree below n.
Eigen::MatrixXd from_nodes(const std::vector<double>& x, std::size_t n) {
  const auto polynomials = [n](const std::vector<double>& at) {
    Eigen::MatrixXd t(at.size(), n);
    const Eigen::Map<const Eigen::ArrayXd> values(at.data(), static_cast<Eigen::Index>(at.size()));
    t.col(0).setOnes();
    if (n > 1) t.col(1) = values;
    for (Eigen::Index k = 2; k < t.cols(); ++k) t.col(k) = 2 * values * t.col(k - 1).array() - t.col(k - 2).array();
    return t;
  };
  std::vector<double> nodes;
  for (std::size_t j = 0; j < n; ++j) nodes.push_back(chebyshev_node(j, n));
  Eigen::MatrixXd known = polynomials(nodes) * (2 / static_cast<double>(n));
  known.col(0) *= 0.5;
  return polynomials(x) * known.transpose();
}

/// powers(x), highest first = matrix x values(nodes).
Eigen::MatrixXd powers_from_nodes(std::size_t n) {
  Eigen::MatrixXd vandermonde(n, n);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k)
      vandermonde(j, k) = std::pow(chebyshev_node(j, n), static_cast<double>(n - 1 - k));
  return vandermonde.inverse();
}

/// b, and its derivatives by u and r.
struct Bend {
  double b, by_u, by_u2, by_r, by_r2, by_ur;

  Bend(double r, double u, double y) {
    const double there = std::sqrt(std::max(r * r - 2 * r * u * y + y * y, 1e-12 + 1e-6 * y * y));  // (E61)
    const double extra = (y * y - 2 * r * u * y) / (there + r);
    b = (y * y + y * u * extra) / (there + r);
    by_u = y - r * y / there;
    by_u2 = -r * r * y * y / (there * there * there);
    const double slope = (r - u * y) / there;
    by_r = slope - 1;
    by_r2 = (1 - slope * slope) / there;
    by_ur = (r * slope / there - 1) * y / there;
  }
};

/// Places (u, r) of a block, in Chebyshev nodes of both.
struct Places {
  std::vector<double> u, r;  ///< nodes
  double widest, middle, half;
};

/// What one place gives at one element and frequency.
class BendValue {
 public:
  BendValue(const WidebandPlan& plan, bool echoes) : plan_(plan), echoes_(echoes) {}

  Complex operator()(const Bend& bend, std::size_t m, std::size_t node) const {
    const double wave = 2 * pi * frequency_of(node) / plan_.medium.sound_speed;
    return echoes_ ? std::polar(1.0, wave * bend.b) * rest(bend, wave, m, node) : std::polar(1.0, -wave * bend.b);
  }
  /// What is left of it beside exp(2 pi i F b / c).
  Complex rest(const Bend& bend, double wave, std::size_t m, std::size_t node) const {
    // The kernel of directions at echoes, around which the phase is a parabola.
    const double step = plan_.period / static_cast<double>(plan_.grid);
    const Complex a = Complex(0, step * wave * bend.by_u), b = Complex(0, step * step * wave * bend.by_u2);
    const Complex* moment = plan_.moment.data() + (m * nodes_of_band + node) * WidebandPlan::moments;
    Complex before = 1, now = a, sum = 1, slope = 0;
    double last = 1;
    for (std::size_t j = 1; j < WidebandPlan::moments; ++j) {
      const Complex part = now * moment[j];
      sum += part;
      slope += static_cast<double>(j) * before * moment[j];
      const double size = std::norm(part);
      if (std::max(size, last) < nothing) break;  // every other one may be 0
      last = size;
      const Complex next = a * now + static_cast<double>(j) * b * before;
      before = now;
      now = next;
    }
    // A Gaussian pulse whose samples are turned by a phase that grows with time: its spectrum is moved. Then what is of
    // second order in time, and in both.
    const double speed = 0.5 * plan_.medium.sound_speed, width = plan_.spectral_width2, turn = speed * wave * bend.by_r;
    const double late = width * (plan_.node_frequency[node] / pi - turn / (4 * pi * pi)),
                 later = late - width * turn / (4 * pi * pi);
    const Complex second = 0.5 * speed * speed * wave * bend.by_r2 * Complex(0, width / (2 * pi * pi) + later * later) +
                           speed * step * wave * bend.by_ur * later * slope * std::conj(sum) / std::norm(sum);
    return std::exp(-turn * late - second) * sum;
  }
  double frequency_of(std::size_t node) const { return plan_.head.pulse.centre_frequency - plan_.node_frequency[node]; }

 private:
  const WidebandPlan& plan_;
  bool echoes_;
};

/// Nodes in range: what interpolation between n of them leaves of a phase that goes by `over_range` to either side,
/// and of its bend over the range.
std::size_t range_nodes(const BendPhase& phase, double near, double far, double tolerance) {
  const double ratio = (far - near) / (far + near);
  const auto most = static_cast<std::size_t>(std::ceil(-std::log10(tolerance)) + 1 + std::ceil(1.4 * phase.over_range));
  double turned = 1, bent = 1;
  for (std::size_t n = 1; n < most; ++n) {
    turned *= 0.5 * phase.over_range / static_cast<double>(n);
    bent *= 0.5 * ratio;
    if (n > 1 && 2 * turned + 2 * (phase.all + 0.3) * bent < node_share * tolerance) return n;
  }
  return most;
}

Places places_of(const WidebandPlan& plan, bool echoes, double first_time, double last_time) {
  Places places;
  const double c = plan.medium.sound_speed, least = 0.45 * plan.aperture;
  places.middle = 0.5 * (first_time + last_time);
  places.half = 0.5 * (last_time - first_time);
  places.widest = 0;
  if (echoes)
    places.widest = plan.widest + 5 * plan.period / static_cast<double>(plan.grid);
  else
    for (const double u : plan.u_beam) places.widest = std::max(places.widest, std::abs(u));
  places.widest = std::max(places.widest, 1e-3);
  // As many as follow phases that change by this much.
  const double near = std::max(0.5 * c * first_time, std::max(least, 1e-3)), far = std::max(0.5 * c * last_time, near);
  const BendPhase phase(plan.head, plan.medium, near, far);
  const auto nodes = [](double turn) { return static_cast<std::size_t>(std::ceil(1.4 * turn)); };
  const std::size_t count_u = 14 + 2 * nodes(0.5 * phase.all * places.widest * places.widest),
                    count_r = range_nodes(phase, near, far, plan.tolerance);
  for (std::size_t j = 0; j < count_u; ++j) places.u.push_back(places.widest * chebyshev_node(j, count_u));
  for (std::size_t j = 0; j < count_r; ++j)
    places.r.push_back(std::max(0.5 * c * (places.middle + places.half * chebyshev_node(j, count_r)), least));
  return places;
}

/// Eliminates rows one after another, the one with most left first: gives what each row is in terms of those.
struct Elimination {
  std::vector<std::size_t> chosen;
  Eigen::MatrixXcd terms;  ///< rows x chosen

  Elimination(RowMatrix a, double tolerance) {
    const auto rows = static_cast<std::size_t>(a.rows());
    const double enough = tolerance * tolerance * a.squaredNorm();
    RowMatrix found(std::min(a.rows(), a.cols()), a.rows());
    Eigen::VectorXd left = a.rowwise().squaredNorm();
    while (left.sum() > enough && chosen.size() < static_cast<std::size_t>(found.rows())) {
      Eigen::Index worst = 0;
      left.maxCoeff(&worst);
      const Eigen::RowVectorXcd q = a.row(worst) / std::sqrt(left[worst]);
      const Eigen::VectorXcd part = a * q.adjoint();
      a.noalias() -= part * q;
      found.row(static_cast<Eigen::Index>(chosen.size())) = part.transpose();
      chosen.push_back(static_cast<std::size_t>(worst));
      left = a.rowwise().squaredNorm();
    }
    const auto n = static_cast<Eigen::Index>(chosen.size());
    Eigen::MatrixXcd all(rows, n), some(n, n);
    for (Eigen::Index k = 0; k < n; ++k) all.col(k) = found.row(k).transpose();
    for (Eigen::Index k = 0; k < n; ++k) some.row(k) = all.row(static_cast<Eigen::Index>(chosen[k]));
    // all = terms x some.
    terms = some.transpose().fullPivLu().solve(all.transpose()).transpose();
  }
};

/// Values at all places, a row each, of some elements and all nodes of frequency, weighted by shading and spectrum.
RowMatrix sampled_bend(const WidebandPlan& plan, const Places& places, const BendValue& value) {
  const std::size_t count_u = places.u.size(), count_r = places.r.size(), elements = plan.elements();
  const std::size_t count_y = std::min(elements, 14 + count_u / 2);
  std::vector<std::size_t> some;
  for (std::size_t j = 0; j < count_y; ++j)
    some.push_back(std::min(elements - 1, static_cast<std::size_t>(0.5 * (1 + chebyshev_node(j, count_y)) *
                                                                   static_cast<double>(elements))));
  std::vector<double> weight;  // of an element at a frequency
  for (std::size_t i = 0; i < count_y; ++i)
    for (std::size_t f = 0; f < nodes_of_band; ++f) {
      const double off = plan.node_frequency[f] / plan.half_band;
      const double spectrum = std::exp(-plan.spectral_width2 * plan.half_band * plan.half_band * off * off);
      weight.push_back(plan.head.array.shading[some[i]] * spectrum *
                       std::pow((1 - std::pow(chebyshev_node(i, count_y), 2)) * (1 - off * off), 0.25));
    }
  RowMatrix sampled(count_u * count_r, count_y * nodes_of_band);
  for (std::size_t j = 0; j < count_u; ++j)
    for (std::size_t k = 0; k < count_r; ++k)
      for (std::size_t i = 0, at = 0; i < count_y; ++i) {
        const Bend bend(places.r[k], places.u[j], plan.y[some[i]]);
        for (std::size_t f = 0; f < nodes_of_band; ++f, ++at)
          sampled(j * count_r + k, at) = weight[at] * value(bend, some[i], f);
      }
  return sampled;
}

/// Along elements and frequency, what the chosen places give.
void add_element_factors(const BendValue& value, const Places& places, const std::vector<std::size_t>& chosen,
                         const WidebandPlan& plan, bool echoes, BendSeries& series) {
  const std::size_t count_r = places.r.size();
  const double c = plan.medium.sound_speed;
  const Eigen::MatrixXd band_powers = powers_from_nodes(nodes_of_band);
  Eigen::MatrixXcd power(nodes_of_band, echoes ? chosen.size() * plan.elements() : 0);
  Eigen::VectorXcd rest(nodes_of_band);
  for (const std::size_t one : chosen)
    for (std::size_t m = 0; m < plan.elements(); ++m) {
      const Bend bend(places.r[one % count_r], places.u[one / count_r], plan.y[m]);
      const auto column = static_cast<Eigen::Index>(series.delay.size());
      series.delay.push_back((echoes ? 1 : -1) * bend.b / c);
      if (!echoes) continue;
      for (std::size_t f = 0; f < nodes_of_band; ++f)
        rest[f] = value.rest(bend, 2 * pi * value.frequency_of(f) / c, m, f);
      power.col(column) = band_powers * rest;
    }
  if (!echoes) return;
  // High powers may be nothing, all of them together.
  Eigen::Index skipped = 0;
  for (double left = power_share * plan.tolerance; skipped + 1 < power.rows(); ++skipped)
    if ((left -= power.row(skipped).cwiseAbs().maxCoeff()) < 0) break;
  series.rest_powers = static_cast<std::size_t>(power.rows() - skipped);
  for (Eigen::Index k = 0; k < power.cols(); ++k)
    for (Eigen::Index f = skipped; f < power.rows(); ++f) {
      series.rest.push_back(static_cast<float>(power(f, k).real()));
      series.rest.push_back(static_cast<float>(power(f, k).imag()));
    }
}

BendSeries bend_of(const WidebandPlan& plan, bool echoes, double first_time, double last_time) {
  const Places places = places_of(plan, echoes, first_time, last_time);
  const std::size_t count_u = places.u.size(), count_r = places.r.size();
  const BendValue value(plan, echoes);
  const Elimination found(sampled_bend(plan, places, value), share * plan.tolerance);

  BendSeries series;
  series.terms = found.chosen.size();
  series.powers = count_r;
  series.middle = places.middle;
  series.half = places.half;

  // Along the steps of the grid, or beams, and time.
  std::vector<double> u = plan.u_beam;
  if (echoes) {
    u.clear();
    for (std::size_t g = 0; g < plan.grid; ++g)
      u.push_back((static_cast<double>(g) / static_cast<double>(plan.grid) - 0.5) * plan.period);
  }
  series.stride = (u.size() + 7) / 8 * 8;
  series.along.assign(series.terms * series.powers * 2 * series.stride, 0);
  std::vector<double> x;
  for (const double one : u) x.push_back(std::clamp(one / places.widest, -1.01, 1.01));
  const Eigen::MatrixXd across = from_nodes(x, count_u), powers = powers_from_nodes(count_r);
  for (std::size_t q = 0; q < series.terms; ++q) {
    const Eigen::Map<const Eigen::MatrixXcd> node(found.terms.col(static_cast<Eigen::Index>(q)).data(), count_r,
                                                  count_u);
    const Eigen::MatrixXcd by_power = powers * node;
    const Eigen::MatrixXd re = across * by_power.real().transpose(), im = across * by_power.imag().transpose();
    float* to = series.along.data() + q * series.powers * 2 * series.stride;
    for (std::size_t k = 0; k < series.powers; ++k, to += 2 * series.stride)
      for (std::size_t i = 0; i < u.size(); ++i) {
        if (std::abs(x[i]) > 1) continue;
        const double undo = echoes ? plan.place_factor[i] : 1;
        to[i] = static_cast<float>(undo * re(i, k));
        to[series.stride + i] = static_cast<float>(undo * im(i, k));
      }
  }

  add_element_factors(value, places, found.chosen, plan, echoes, series);
  return series;
}

}  // namespace

BendSeries bend_of_echoes(const WidebandPlan& plan, double first_time, double last_time) {
  return bend_of(plan, true, first_time, last_time);
}

BendSeries bend_of_beams(const WidebandPlan& plan, double first_time, double last_time) {
  return bend_of(plan, false, first_time, last_time);
}

}  // namespace insonify
