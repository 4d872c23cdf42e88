// SPDX-License-Identifier: BSD-3-Clause
// X3D (ISO/IEC 19776-1) is rewritten so that Assimp finds all in its place: it leaves the parent of a group that is empty,
// or that is the USE of another, too early, and puts what follows there. Names of materials are lost in it, too.
#include <map>
#include <vector>

#include "core/error.hpp"
#include "scene_io/raw_cloud_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t most_growth = 64 << 20;  // most bytes that groups which are used again may add
constexpr std::size_t deepest_element = 500;

class X3dRewriter {
 public:
  X3dRewriter(const std::string& path, std::string_view text) : path_(path), text_(text) { out_.reserve(text.size()); }

  std::string rewritten() {
    while (at_ < text_.size()) {
      copy_until(std::min(text_.find('<', at_), text_.size()));
      const std::string_view left = text_.substr(at_);
      if (left.starts_with("<!--"))
        copy_past("-->");
      else if (left.starts_with("<![CDATA["))
        copy_past("]]>");
      else if (left.starts_with("<?") || left.starts_with("<!"))
        copy_past(">");
      else if (!left.empty())
        read_tag();
    }
    return std::move(out_);
  }

 private:
  /// An element that has begun.
  struct Open {
    std::string type, name;  ///< with the name after DEF
    std::size_t begin;       ///< its place in out_
    bool filled = false;     ///< true: other elements are in it
  };
  /// An element with a name that has ended.
  struct Known {
    std::size_t begin, end;  ///< its place in out_
    std::string material;    ///< name of the material of a Shape or Appearance
  };

  void copy_until(std::size_t end) {
    out_ += text_.substr(at_, end - at_);
    at_ = end;
  }
  void copy_past(std::string_view mark) {
    const std::size_t found = text_.find(mark, at_);
    copy_until(found == text_.npos ? text_.size() : found + mark.size());
  }

  /// Returns the tag that begins here, and moves on behind it.
  std::string_view take_tag() {
    std::size_t end = at_;
    for (char quote = 0; end < text_.size() && (quote != 0 || text_[end] != '>'); ++end)
      if (quote != 0 ? text_[end] == quote : text_[end] == '"' || text_[end] == '\'')
        quote = quote != 0 ? '\0' : text_[end];
    const std::string_view tag = text_.substr(at_, end + 1 - at_);
    at_ = std::min(end + 1, text_.size());
    return tag;
  }

  /// Returns the value of an attribute as it stands between its quotes; nothing if the tag has none of the name.
  static std::string attribute(std::string_view tag, std::string_view name) {
    constexpr std::string_view blanks = " \t\r\n";
    for (std::size_t at = tag.find_first_of(blanks); at < tag.size();) {
      const std::size_t begin = tag.find_first_not_of(blanks, at), equals = tag.find('=', at);
      const std::size_t open = tag.find_first_of("\"'", equals);
      const std::size_t close = open < tag.size() ? tag.find(tag[open], open + 1) : tag.npos;
      if (close == tag.npos) break;
      if (tag.substr(begin, tag.find_first_of(" \t\r\n=", begin) - begin) == name)
        return std::string(tag.substr(open + 1, close - open - 1));
      at = close + 1;
    }
    return "";
  }

  static bool is_group(const std::string& type) {
    return type == "Group" || type == "StaticGroup" || type == "Switch" || type == "Transform";
  }

  void read_tag() {
    const std::string_view tag = take_tag();
    if (tag.starts_with("</")) return close(tag);
    const bool alone = tag.ends_with("/>");
    const std::string type(tag.substr(1, tag.find_first_of(" \t\r\n/>") - 1)), use = attribute(tag, "USE");
    if (type == "Inline")
      fail(ErrorKind::content, path_, ": nodes of type Inline are not read; export it as one file, or as .glb");
    if (open_.size() == deepest_element)
      fail(ErrorKind::content, path_, ": more than ", deepest_element,
           " elements are within each other; export it with fewer levels, or as .glb");
    if (!open_.empty()) open_.back().filled = true;
    open_.push_back({type, attribute(tag, "DEF"), out_.size(), false});
    if (type == "Shape") material_.clear();
    if (type == "Material") material_ = use.empty() ? open_.back().name : use;
    const auto known = known_.find(use);
    if (known != known_.end() && (type == "Shape" || type == "Appearance")) material_ = known->second.material;
    if (known != known_.end() && is_group(type)) {
      open_.back() = {"", "", out_.size(), true};
      copy_group(known->second);
      if (alone) open_.pop_back();
    } else if (alone && is_group(type)) {
      out_.append(tag.substr(0, tag.size() - 2)) += '>';
      close("</" + type + ">");
    } else {
      out_ += tag;
      if (alone) close("");
    }
  }

  void copy_group(const Known& group) {
    if (out_.size() + (group.end - group.begin) > text_.size() + most_growth)
      fail(ErrorKind::content, path_, ": groups that are used again make it larger by more than ", most_growth >> 20,
           " MiB; export fewer copies, or as .glb");
    out_.append(out_, group.begin, group.end - group.begin);
  }

  /// Ends the element that began last by a tag; by none if it stood alone.
  void close(std::string_view tag) {
    if (open_.empty()) {
      out_ += tag;
      return;
    }
    const Open ended = std::move(open_.back());
    open_.pop_back();
    if (ended.type.empty()) return;  // the USE of a group, which has been copied
    if (is_group(ended.type) && !ended.filled) out_ += "<WorldInfo/>";
    out_ += tag;
    // Assimp keeps the names of groups.
    if (ended.type == "Shape") {
      const char quote = material_.find('"') == material_.npos ? '"' : '\'';
      const std::string name = std::string(x3d_material) + (material_.empty() ? "default" : material_);
      out_.insert(ended.begin, std::string("<Group DEF=") + quote + name + quote + ">");
      out_ += "</Group>";
    }
    if (!ended.name.empty()) known_[ended.name] = {ended.begin, out_.size(), material_};
  }

  const std::string& path_;
  std::string_view text_;
  std::size_t at_ = 0;  ///< place in text_
  std::string out_;
  std::vector<Open> open_;
  std::map<std::string, Known> known_;
  std::string material_;  ///< name of the last material of the shape
};

}  // namespace

std::string x3d_for_assimp(const std::string& path, std::string_view text) {
  if (text.find('\0') != text.npos)
    fail(ErrorKind::content, path, ": holds zero bytes, as text in UTF-16 does; save it as UTF-8, or as .glb");
  return X3dRewriter(path, text).rewritten();
}

}  // namespace insonify
