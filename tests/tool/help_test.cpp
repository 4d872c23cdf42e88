// SPDX-License-Identifier: BSD-3-Clause
// --help, man pages and completions of shells come from one description of the options.
#include <algorithm>
#include <regex>

#include "scene_io/describe_file.hpp"
#include "tool/command/option_list.hpp"
#include "tool/tool_runner.hpp"
#include "tool/verbs_in_help.hpp"

using namespace insonify;

namespace {

class Help : public ToolTest {
 protected:
  std::vector<std::string> verbs() const { return verbs_in(succeed("--help")); }

  // Long names of the options in a help text.
  static std::set<std::string> options_in(const std::string& help) {
    std::set<std::string> names;
    const std::regex option("\n  (?:-[a-z],)?(--[a-z-]+)");
    for (std::sregex_iterator i(help.begin(), help.end(), option), end; i != end; ++i) names.insert((*i)[1]);
    return names;
  }

  // Returns what bash proposes for word number `count` of a line, counted from 0.
  std::string proposed(const std::string& words, int count) const {
    const std::string script = "source <(" INSONIFY_TOOL " completion bash); COMP_WORDS=(" + words +
                               "); COMP_CWORD=" + std::to_string(count) + "; _insonify; echo \"${COMPREPLY[*]}\"";
    write("complete.sh", script);
    EXPECT_EQ(std::system(("bash '" + path("complete.sh") + "' > '" + path("proposed") + "'").c_str()), 0);
    return read("proposed");
  }
};

std::string without(std::string text, char unwanted) {
  std::erase(text, unwanted);
  return text;
}

}  // namespace

TEST_F(Help, man_pages_and_completions_name_every_option) {
  const std::string bash = succeed("completion bash"), zsh = succeed("completion zsh"),
                    fish = succeed("completion fish");
  ASSERT_GT(verbs().size(), 12u);
  for (const std::string& verb : verbs()) {
    EXPECT_THAT(bash, HasSubstr(" " + verb + " "));
    EXPECT_THAT(zsh, HasSubstr("'" + verb + ":"));
    EXPECT_THAT(fish, HasSubstr("-a " + verb + " "));
    if (verb == "view") continue;  // the viewer parses its own options
    const std::string help = succeed(verb + " --help"), page = without(succeed("man " + verb), '\\');
    for (const std::string& option : options_in(help)) {
      if (option == "--help") continue;
      EXPECT_THAT(page, HasSubstr(option)) << verb;
      EXPECT_THAT(bash, HasSubstr(option)) << verb;
      EXPECT_THAT(zsh, HasSubstr("'*" + option + "[")) << verb;
      EXPECT_THAT(fish, HasSubstr(" -l " + option.substr(2))) << verb;
    }
  }
}

TEST_F(Help, fits_the_terminal_and_shows_defaults_units_and_ranges) {
  setenv("COLUMNS", "90", 1);
  for (const std::string& verb : verbs()) {
    if (verb == "view") continue;
    std::istringstream help(succeed(verb + " --help"));
    bool examples = false;
    for (std::string line; std::getline(help, line);) {
      examples = examples || line.starts_with("Examples:");
      if (!examples && !line.starts_with("Usage:")) {
        EXPECT_LE(line.size(), 90u) << verb << ": " << line;
      }
    }
  }
  const std::string help = std::regex_replace(succeed("ping --help"), std::regex("\\s+"), " ");
  for (const char* text : {"--accuracy-db FLOAT", "; default 0.1", "(0 to 1024)", "--seed UINT"})
    EXPECT_THAT(help, HasSubstr(text));
}

TEST_F(Help, is_a_verb_too_and_unknown_verbs_are_corrected) {
  EXPECT_EQ(succeed("help ping"), succeed("ping --help"));
  EXPECT_EQ(succeed("help"), succeed("--help"));
  expect_refused("", 2, {"no verb is given; begin with one, e.g. insonify info FILE", "insonify --help"});
  expect_refused("pnig", 2, {"unknown verb 'pnig'; did you mean 'ping'?", "insonify --help"});
  expect_refused("info plane.ply --jsno", 2,
                 {"unknown option '--jsno'; did you mean '--json'?", "insonify info --help"});
  expect_refused("ping plane.ply --sonar p900-45 --pose=0,0,0,0,0,0 -o x --rnge=1:3", 2,
                 {"unknown option '--rnge'; did you mean '--range'?"});
  expect_refused("beampattern p900-45 reef.ply", 2,
                 {"'reef.ply' is one argument too many; see insonify beampattern --help"});
  expect_refused("bogus --help", 2, {"unknown verb 'bogus'"});
  expect_refused("help bogus", 2, {"unknown verb 'bogus'"});
  EXPECT_THAT(run("man pnig").err, HasSubstr("unknown verb 'pnig'; did you mean 'ping'?"));
  EXPECT_EQ(run("completion csh").exit_code, 2);
}

TEST_F(Help, bash_completes_verbs_options_and_words) {
  EXPECT_EQ(proposed("insonify pi", 1), "ping\n");
  EXPECT_EQ(proposed("insonify ping --accuracy", 2), "--accuracy-db\n");
  EXPECT_EQ(proposed("insonify ping --world n", 3), "ned\n");
  EXPECT_EQ(proposed("insonify completion z", 2), "zsh\n");
}

TEST_F(Help, shells_complete_a_scene_with_files_of_the_formats_that_are_read) {
  for (const char* name : {"s.ply", "s.tiles", "s.toml", "s.step", "s.png"}) write(name, "");
  std::filesystem::create_directory(path("s.folder"));
  const std::string here = path("s");
  EXPECT_EQ(proposed("insonify prepare " + here, 2),
            here + ".folder " + here + ".ply " + here + ".tiles " + here + ".toml\n");
  EXPECT_EQ(proposed("insonify prepare a.ply -o " + here, 4), "\n");  // any file
  EXPECT_THAT(succeed("completion zsh"), HasSubstr("'::SCENE:_files -g \"*(.pcd|.ply|"));
  EXPECT_THAT(succeed("completion fish"), HasSubstr("(__fish_complete_suffix .pcd .ply "));
}

TEST_F(Help, exit_codes_are_those_of_the_docs) {
  std::stringstream page;
  page << std::ifstream(INSONIFY_TROUBLES_PAGE).rdbuf();
  EXPECT_THAT(std::regex_replace(page.str(), std::regex("\n"), " "),
              HasSubstr("Exit codes: " + tool::exit_codes_text() + "."));
  EXPECT_THAT(succeed("man ping"), HasSubstr(".SH EXIT STATUS\n" + tool::exit_codes_text()));
}

TEST_F(Help, verbs_and_formats_of_scenes_are_in_the_docs) {
  const auto page = [](const std::string& name) {
    std::stringstream text;
    text << std::ifstream(std::string(INSONIFY_ROOT) + "/" + name).rdbuf();
    return text.str();
  };
  const std::string readme = page("README.md"), formats = page("docs/scene-files.md");
  for (const std::string& verb : verbs())
    EXPECT_TRUE(std::regex_search(readme, std::regex("(insonify |`)" + verb + "[ `]"))) << "README.md lacks " << verb;
  // Each extension stands in a row of the table that ends with the library that reads it.
  for (const SceneFormat& format : scene_formats())
    for (const std::string& extension : format.extensions)
      EXPECT_TRUE(std::regex_search(formats, std::regex("\\n\\|[^|\n]*`\\" + extension + "`[^|\n]*\\|[^|\n]*\\| " +
                                                        (format.package.empty() ? "not read" : format.package))))
          << "docs/scene-files.md lacks " << extension << " with " << format.package;
}

TEST_F(Help, colour_maps_are_words) {
  expect_refused("image run --colormap rainbow -o x.png", 2, {"--colormap", "rainbow", "viridis", "grey"});
  EXPECT_EQ(proposed("insonify image --colormap vir", 3), "viridis\n");
}

TEST_F(Help, seeds_have_no_sign_and_pictures_are_png) {
  expect_refused("make-scene plane -o plane.ply --seed -1", 2, {"--seed", "-1 must be 0 or more"});
  expect_refused("beampattern p900-45 -o pattern.jpg", 2, {"pattern.jpg", "must end with .png"});
}

TEST_F(Help, standard_output_that_cannot_be_written_is_an_error) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const auto exit_code = [](const std::string& line) {
    const int status = std::system(("bash -c '" + line + "' 2>/dev/null").c_str());
    return WEXITSTATUS(status);
  };
  EXPECT_EQ(exit_code(INSONIFY_TOOL " sonars >/dev/full"), 4);
  EXPECT_EQ(exit_code(INSONIFY_TOOL " sonars | true; exit ${PIPESTATUS[0]}"), 128 + SIGPIPE);
  EXPECT_EQ(exit_code(INSONIFY_TOOL " sonars | head -1"), 0);
}
