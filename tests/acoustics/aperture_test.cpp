// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/aperture.hpp"

#include "support/test.hpp"

namespace {

using complex = std::complex<double>;
using Eigen::Vector2d;

ConvexPolygon rectangle(double x0, double x1, double y0, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
complex edges(double v1, double v2) { return (fresnel_integral(v2) - fresnel_integral(v1)) / complex(1, 1); }

}  // namespace

// Reference: Abramowitz and Stegun, table 7.7.
TEST(Fresnel, integrals_are_the_tabulated_ones) {
  const double table[][3] = {{0.5, 0.4923442, 0.0647324},
                             {1.0, 0.7798934, 0.4382591},
                             {1.5, 0.4452612, 0.6975050},
                             {2.0, 0.4882534, 0.3434157},
                             {5.0, 0.5636312, 0.4991914}};
  for (const auto& [x, c, s] : table) {
    EXPECT_LT(std::abs(fresnel_integral(x) - complex(c, s)), 1e-7) << x;
    EXPECT_EQ(fresnel_integral(-x), -fresnel_integral(x));
  }
}

TEST(Aperture, of_a_rectangle_is_the_product_of_its_edges) {
  const double all[][4] = {{-1, 2, -.5, 3},      {.5, 2, -1, 1},         {-8, 7, -.01, 12}, {-30, 20, 3, 9},
                           {-4, 6, 1e-9, 4},     {-.02, .03, -.01, .04}, {0, 5, 0, 5},      {-700, 3, -2000, -.3},
                           {-1e6, 1e6, -2, 1e6}, {-1e6, .7, -1e6, 1e6}};
  for (const auto& [x0, x1, y0, y1] : all)
    EXPECT_LT(std::abs(aperture_factor(rectangle(x0, x1, y0, y1)) - edges(x0, x1) * edges(y0, y1)), 1e-5)
        << x0 << " " << x1 << " " << y0 << " " << y1;
}

// A turned aperture has the same factor. The factors of two parts cut by a diagonal add up to that of the whole.
TEST(Aperture, adds_up_and_does_not_depend_on_axes) {
  const ConvexPolygon whole = rectangle(-3, 1, -0.5, 2.2);
  const complex factor = aperture_factor(whole);
  ConvexPolygon turned = whole;
  for (Vector2d& v : turned) v = Vector2d(0.6 * v.x() - 0.8 * v.y(), 0.8 * v.x() + 0.6 * v.y());
  EXPECT_LT(std::abs(aperture_factor(turned) - factor), 1e-5);
  const complex parts =
      aperture_factor(clipped(whole, Vector2d(1, 2), 0.3)) + aperture_factor(clipped(whole, Vector2d(-1, -2), -0.3));
  EXPECT_LT(std::abs(parts - factor), 1e-5);
  EXPECT_LT(std::abs(aperture_factor(clipped(whole, rectangle(0, 9, -9, 9))) - edges(0, 1) * edges(-.5, 2.2)), 1e-5);
  EXPECT_TRUE(clipped(whole, rectangle(2, 3, 0, 1)).empty());
}

TEST(Aperture, passes_all_within_and_half_on_an_edge) {
  EXPECT_LT(std::abs(aperture_factor(rectangle(-1e6, 1e6, -1e6, 1e6)) - 1.0), 1e-5);
  EXPECT_LT(std::abs(aperture_factor(rectangle(0, 1e6, -1e6, 1e6)) - 0.5), 1e-5);
  EXPECT_LT(std::abs(aperture_factor(rectangle(0, 1e6, 0, 1e6)) - 0.25), 1e-5);
  EXPECT_LT(std::abs(aperture_factor(rectangle(1e4, 1e6, -1e6, 1e6))), 1e-4);
}
