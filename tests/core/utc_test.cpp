#include "core/utc.hpp"

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
