// SPDX-License-Identifier: BSD-3-Clause
#include "files/utc.hpp"

#include "support/test.hpp"

TEST(Utc, goes_on_over_days_and_years) {
  EXPECT_EQ(utc_after("2026-05-01T08:30:00Z", 0), "2026-05-01T08:30:00.000Z");
  EXPECT_EQ(utc_after("2026-12-31T23:59:59.5Z", 0.75), "2027-01-01T00:00:00.250Z");
  EXPECT_EQ(utc_after("2024-02-28T12:00:00Z", 86400), "2024-02-29T12:00:00.000Z");
  EXPECT_EQ(utc_after("2026-03-01T00:00:00Z", -0.001), "2026-02-28T23:59:59.999Z");
  for (const char* bad :
       {"2026-13-01T00:00:00Z", "2026-02-30T00:00:00Z", "2026-05-01T24:00:00Z", "2026-05-01", "2026-05-01T08:30:00"})
    EXPECT_THAT(error_of([&] { utc_after(bad, 0); }), HasSubstr(bad));
}

// Known pairs: GPS week 2416, day 5 begins 18 s before 2026-05-01 in UTC; the second that ended 2016 was the
// eighteenth.
TEST(Utc, gives_gps_time_with_leap_seconds) {
  EXPECT_EQ(gps_time_of_utc(315964800), 0);
  EXPECT_EQ(gps_time_of_utc(1777593600 - 18), (2416 * 7 + 5) * 86400.0);
  EXPECT_EQ(leap_seconds_of_gps(0), 0);
  EXPECT_EQ(leap_seconds_of_gps(1483228799.5), 17);
  EXPECT_EQ(leap_seconds_of_gps(1483228800), 18);
  EXPECT_EQ(leap_seconds_of_gps(362793599.5), 0);
  EXPECT_EQ(leap_seconds_of_gps(362793600), 1);
  EXPECT_EQ(leap_seconds_of_gps(1e10), 18);
}
