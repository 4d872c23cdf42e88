// SPDX-License-Identifier: BSD-3-Clause
#include "store/csv_tables.hpp"
#include "support/test.hpp"

namespace {

std::string refusal(const std::string& text) { return error_of_file(load_labels, "labels.csv", text); }

void refuses_labels(const std::string& text, const std::string& what) {
  EXPECT_EQ(refusal(text), "content: labels.csv:" + what);
}

}  // namespace

TEST(LabelTable, holds_bearing_range_and_any_text) {
  const auto labels =
      load_labels(own_file("labels.csv",
                           "\xEF\xBB\xBF# of the harbour\nbearing_deg,range_m,text\r\n\n-12.5,20,Wreck, "
                           "bow\r\n+3,7.25,\"Pipe \"\"A\"\"\"\n0,1,Mühle λ\n"));
  ASSERT_EQ(labels.size(), 3U);
  EXPECT_EQ(labels[0].bearing_deg, -12.5);
  EXPECT_EQ(labels[0].range, 20);
  EXPECT_EQ(labels[0].text, "Wreck, bow");
  EXPECT_EQ(labels[1].bearing_deg, 3);
  EXPECT_EQ(labels[1].text, "Pipe \"A\"");
  EXPECT_EQ(labels[2].text, "Mühle λ");
}

TEST(LabelTable, refuses_what_is_no_label_with_file_and_line) {
  refuses_labels("bearing,range,text\n", "1: header is 'bearing,range,text', must be bearing_deg,range_m,text");
  refuses_labels("bearing_deg,range_m,text\n1,2,a\n1;2;b\n",
                 "3: has fewer than 3 columns, must be bearing_deg,range_m,text");
  refuses_labels("bearing_deg,range_m,text\neast,2,a\n", "2: bearing_deg = 'east', must be a finite number");
  refuses_labels("bearing_deg,range_m,text\n1,nan,a\n", "2: range_m = 'nan', must be a finite number");
  refuses_labels("bearing_deg,range_m,text\n400,2,a\n", "2: bearing_deg = 400 deg, must be within -360 and 360");
  refuses_labels("bearing_deg,range_m,text\n4,0,a\n", "2: range_m = 0 m, must be > 0");
  EXPECT_THAT(refusal("bearing_deg,range_m,text\n"), HasSubstr("labels.csv: has no labels"));
  EXPECT_THAT(error_with_kind([] { load_labels(own_path("none.csv")); }), HasSubstr("file: "));
}
