// SPDX-License-Identifier: BSD-3-Clause
#include "core/message.hpp"

#include "support/test.hpp"

using namespace insonify;

TEST(Message, texts_of_up_to_200_bytes_stay) {
  EXPECT_EQ(shortened("wreck"), "wreck");
  EXPECT_EQ(shortened(std::string(200, 'x')), std::string(200, 'x'));
}

TEST(Message, longer_texts_are_cut_in_the_middle) {
  const std::string cut = shortened("begin" + std::string(5000, 'x') + "end");
  EXPECT_LE(cut.size(), 200u);
  EXPECT_GT(cut.size(), 190u);
  EXPECT_TRUE(cut.starts_with("beginxxx") && cut.ends_with("xxxend"));
  EXPECT_NE(cut.find("x ... x"), cut.npos);
}

TEST(Message, characters_of_utf_8_are_not_split) {
  // One to four bytes each, at all positions relative to the cuts.
  for (const std::string character : {"a", "ü", "€", "\xf0\x9f\x90\x9f"})
    for (std::size_t shift = 0; shift < 4; ++shift) {
      std::string text(shift, '.');
      for (int i = 0; i < 300; ++i) text += character;
      std::string cut = shortened(text);
      cut.replace(cut.find(" ... "), 5, "").erase(0, shift);
      ASSERT_EQ(cut.size() % character.size(), 0u);
      for (std::size_t at = 0; at < cut.size(); at += character.size())
        ASSERT_EQ(cut.substr(at, character.size()), character);
    }
  EXPECT_LE(shortened(std::string(5000, '\x80')).size(), 200u) << "bytes that are no UTF-8";
}

TEST(Message, is_one_line_without_control_characters) {
  EXPECT_EQ(message_line("a.toml:3: name = 'x\ny\x1b[31m\x7f'"), "a.toml:3: name = 'x y [31m '");
  EXPECT_EQ(message_line(""), "");
  EXPECT_EQ(message_line("two  blanks "), "two  blanks ");
}

TEST(Message, cuts_words_that_are_no_paths) {
  std::string path;
  for (int i = 0; i < 15; ++i) path += "/" + std::string(250, 'p');
  const std::string line = message_line(path + ":7: key '" + std::string(5000, 'k') + "' is unknown; see the docs");
  EXPECT_TRUE(line.starts_with(path + ":7: key 'kkk")) << "the path stays whole";
  EXPECT_TRUE(line.ends_with("kkk' is unknown; see the docs"));
  EXPECT_LE(line.size(), path.size() + 250);
  EXPECT_LE(message_line(path + path).size(), 200u) << "longer than any path";
}

TEST(Message, cuts_texts_in_quotes_that_have_blanks) {
  std::string prose;
  for (int i = 0; i < 1000; ++i) prose += "don't 'go' there ";
  for (const std::string& text :
       {std::string(5000, '-') + " b", std::string(2500, 'a') + " " + std::string(2500, 'b')}) {
    const std::string line = message_line("a.toml:7: material 'sand', like '" + text + "', is not known");
    EXPECT_TRUE(line.starts_with("a.toml:7: material 'sand', like '" + text.substr(0, 90)));
    EXPECT_TRUE(line.ends_with("b', is not known"));
    EXPECT_LE(line.size(), 260u);
  }
  EXPECT_LE(message_line("a.toml:7: '" + prose + "'").size(), 2100u);
  const std::string own = "the scene's head 'fls' needs '" + std::string(150, 'w') + " " + std::string(100, 'w') + "'";
  EXPECT_EQ(message_line(own), own);
}

TEST(Message, has_at_most_2000_bytes_beside_paths) {
  std::string words;
  for (int i = 0; i < 5000; ++i) words += "word ";
  const std::string line = message_line("a.toml:1: " + words + "must end");
  EXPECT_TRUE(line.starts_with("a.toml:1: word word") && line.ends_with("word must end"));
  EXPECT_NE(line.find("word ... word"), line.npos);
  EXPECT_LE(line.size(), 2005u);
  EXPECT_GT(line.size(), 1950u);
}

TEST(Message, lists_show_ten_entries_and_the_number_of_the_others) {
  std::vector<std::string> names;
  EXPECT_EQ(shortened_list(names), "");
  for (int i = 1; i <= 10; ++i) names.push_back("n" + std::to_string(i));
  EXPECT_EQ(shortened_list(names), "n1, n2, n3, n4, n5, n6, n7, n8, n9, n10");
  for (int i = 11; i <= 5000; ++i) names.push_back("n" + std::to_string(i));
  EXPECT_EQ(shortened_list(names, " "), "n1 n2 n3 n4 n5 n6 n7 n8 n9 n10 and 4990 more");
  const auto length = [](const std::string& name) { return std::to_string(name.size()); };
  EXPECT_EQ(shortened_list(std::vector{std::string(3, 'x')}, ", ", length), "3");
}
