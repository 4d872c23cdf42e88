// SPDX-License-Identifier: BSD-3-Clause
// VRML 2.0 (ISO/IEC 14772-1) is written as X3D (ISO/IEC 19776-1), whose nodes and fields have the same names.
#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/text_lines.hpp"
#include "files/input_file.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

namespace insonify {
namespace {

constexpr int deepest_node = 200;

class VrmlText {
 public:
  explicit VrmlText(const std::string& path) : path_(path), text_(read_whole_file(path)) {
    if (!text_.starts_with("#VRML V2.0"))
      fail(ErrorKind::content, path, ": not a VRML 2.0 file: expected '#VRML V2.0', found ", what_it_looks_like(path),
           "; export it again");
    advance();
  }

  /// Returns the elements of all nodes.
  std::string elements() {
    std::string all;
    while (!word_.empty())
      if (!skipped_route()) all += element(0);
    return all;
  }

 private:
  /// Moves on to the next word, bracket or text in quotes; word_ is empty at the end.
  void advance() {
    const auto filled_from = [&](std::size_t from) { return text_.find_first_not_of(" \t\r\n,", from); };
    std::size_t begin = filled_from(end_);
    while (begin < text_.size() && text_[begin] == '#')
      begin = filled_from(std::min(text_.find('\n', begin), text_.size()));
    begin_ = std::min(begin, text_.size());
    end_ = std::min(text_.find_first_of(" \t\r\n,#\"{}[]", begin_), text_.size());
    if (end_ == begin_ && end_ < text_.size()) ++end_;  // a bracket or quote
    if (begin_ < text_.size() && text_[begin_] == '"') {
      while (end_ < text_.size() && text_[end_] != '"') end_ += text_[end_] == '\\' ? 2 : 1;
      end_ = std::min(end_ + 1, text_.size());
    }
    word_ = std::string_view(text_).substr(begin_, end_ - begin_);
  }

  std::string take() {
    const std::string taken(word_);
    advance();
    return taken;
  }
  bool take_if(std::string_view word) {
    const bool same = word_ == word;
    if (same) advance();
    return same;
  }
  [[noreturn]] void refuse(const std::string& expected) const {
    fail(ErrorKind::content, path_, ":", 1 + std::count(text_.begin(), text_.begin() + begin_, '\n'), ": expected ",
         expected, ", found '", shown(word_), "'; correct the line, or export the file again if it is cut off");
  }
  /// Takes the name of a field, or of a type of nodes.
  std::string take_name() {
    const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    if (word_.empty() || !std::all_of(word_.begin(), word_.end(), fits) || std::isdigit(word_[0]))
      refuse("a node or field");
    return take();
  }
  bool is_value() const {
    return word_ == "TRUE" || word_ == "FALSE" ||
           (!word_.empty() && std::string_view("+-.0123456789\"").find(word_[0]) != std::string_view::npos);
  }
  std::string value() { return take_if("TRUE") ? "true" : take_if("FALSE") ? "false" : take(); }
  /// Skips "ROUTE a TO b", which moves nothing at the begin of time.
  bool skipped_route() {
    if (word_ != "ROUTE") return false;
    for (int k = 0; k < 4; ++k) advance();
    return true;
  }

  void skip_body() {
    int open = 0;
    do {
      if (word_.empty()) refuse("'}'");
      open += (word_ == "{") - (word_ == "}");
      advance();
    } while (open > 0);
  }

  static std::string attribute(const std::string& name, const std::string& value) {
    std::string escaped;
    for (const char c : value)
      escaped += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '\'' ? "&apos;" : std::string(1, c);
    return " " + name + "='" + escaped + "'";
  }

  /// Returns a type of nodes that Assimp reads in place of one that it leaves out with its children.
  static std::string x3d_type(const std::string& type) {
    const bool grouped = type == "Anchor" || type == "Billboard" || type == "Collision";
    return grouped ? "Group" : type == "LOD" ? "Switch" : type;
  }

  /// Returns the element of the node that begins here.
  std::string element(int depth) {
    if (depth > deepest_node) refuse("at most " + std::to_string(deepest_node) + " nodes within each other");
    if (take_if("USE")) {
      const auto known = known_.find(take());
      if (known == known_.end()) refuse("the name of a node before USE");
      return "<" + known->second + attribute("USE", known->first) + "/>";
    }
    const std::string name = take_if("DEF") ? take() : "", own_type = take_name(), type = x3d_type(own_type);
    for (const char* other : {"PROTO", "EXTERNPROTO", "Inline"})
      if (type == other)
        fail(ErrorKind::content, path_, ": nodes of type ", type,
             " are not read; export it as one file of plain nodes, or as .glb");
    if (word_ != "{") refuse("'{'");
    if (type == "Script") return skip_body(), "";
    advance();
    std::map<std::string, std::string> fields;
    if (!name.empty()) fields["DEF"] = name;
    if (own_type == "LOD") fields["whichChoice"] = "0";  // the finest level
    std::string children, attributes;
    while (!take_if("}"))
      if (!skipped_route()) read_field(depth, fields, children);
    if (fields["ccw"] == "false") turn_over(type, fields["coordIndex"]);
    for (const auto& [field, values] : fields)
      if (!values.empty()) attributes += attribute(field, values);
    if (!name.empty()) known_[name] = type;
    return "<" + type + attributes + ">" + children + "</" + type + ">";
  }

  /// Reads the values of a field, or its nodes into the children. Numbers of faces that no mesh needs are left out.
  void read_field(int depth, std::map<std::string, std::string>& fields, std::string& children) {
    static const std::set<std::string> unused = {"color",    "colorIndex",    "normal", "normalIndex",
                                                 "texCoord", "texCoordIndex", "proxy"};
    const std::string field = take_name();
    const bool several = take_if("["), left_out = unused.contains(field);
    std::string values, nodes;
    for (bool first = true; several ? !take_if("]") : first || is_value(); first = false)
      if (is_value())
        values += (values.empty() ? "" : " ") + value();
      else if (!skipped_route() && !take_if("NULL"))
        nodes += element(depth + 1);
    if (left_out) return;
    children += nodes;
    fields[field] = values;
  }

  /// Reverses the corners of faces whose outside is the other one, which Assimp takes for the same.
  void turn_over(const std::string& type, std::string& corners) const {
    if (corners.empty())
      fail(ErrorKind::content, path_, ": nodes of type ", type,
           " with 'ccw FALSE' are not read; export it without that, or as .glb");
    std::vector<std::string> words = words_of(corners);
    while (!words.empty() && words.back() == "-1") words.pop_back();
    std::reverse(words.begin(), words.end());
    corners = joined(words, " ");
  }

  std::string path_, text_;
  std::size_t begin_ = 0, end_ = 0;  ///< the place of word_
  std::string_view word_;
  std::map<std::string, std::string> known_;  ///< types of nodes by their names
};

}  // namespace

std::string vrml_as_x3d(const std::string& path) {
  return "<?xml version=\"1.0\"?><X3D version=\"3.0\"><Scene><Group>" + VrmlText(path).elements() +
         "</Group></Scene></X3D>";
}

}  // namespace insonify
