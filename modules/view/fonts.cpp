// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextRenderer.h>

#include "view/canvas_internal.hpp"
#include "view/off_screen_internal.hpp"
#include "view/placed_text.hpp"

namespace insonify {
namespace {

// Usual paths on Debian, Fedora, Arch and of manual installations; VTK needs the file, not the name.
constexpr const char* font_files[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                      "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                      "/usr/share/fonts/dejavu/DejaVuSans.ttf",
                                      "/usr/share/fonts/TTF/DejaVuSans.ttf",
                                      "/usr/local/share/fonts/DejaVuSans.ttf",
                                      "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
                                      "/usr/share/fonts/truetype/freefont/FreeSans.ttf",
                                      "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf"};

// Returns the first font file that exists, or "".
std::string font_file() {
  std::error_code ignored;
  for (const char* file : font_files)
    if (std::filesystem::exists(file, ignored)) return file;
  return {};
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

// Removes the last character of UTF-8 text.
void drop_last_letter(std::string& text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.pop_back();
  if (!text.empty()) text.pop_back();
}

}  // namespace

void set_font(vtkTextProperty* property, int font_size) {
  const std::string file = font_file();
  if (file.empty()) {
    property->SetFontFamilyToArial();
  } else {
    property->SetFontFamily(VTK_FONT_FILE);
    property->SetFontFile(file.c_str());
  }
  property->SetFontSize(font_size);
  property->BoldOff();
  property->ItalicOff();
  property->ShadowOff();
}

std::string readable_text(const std::string& text) {
  if (!font_file().empty()) return text;
  std::string plain = text;
  for (const char* micro : {"\u00b5", "\u03bc"}) replace_all(plain, micro, "u");
  return plain;
}

TextSize text_size(const std::string& text, int font_size) {
  const VtkTurn turn;
  vtkNew<vtkTextProperty> property;
  set_font(property, font_size);
  int box[4] = {0, 0, 0, 0};
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  if (text.empty() || !renderer || !renderer->GetBoundingBox(property, readable_text(text).c_str(), box, 72)) return {};
  return {static_cast<double>(box[1] - box[0] + 1), static_cast<double>(box[3] - box[2] + 1)};
}

FittedText fit_text(const std::string& text, int font_size, double width) {
  FittedText fitted{text, font_size};
  double needed = text_size(text, font_size).width;
  while (needed > width && 10 * fitted.font_size > 7 * font_size) needed = text_size(text, --fitted.font_size).width;
  for (std::string head = text; needed > width && !head.empty();) {
    drop_last_letter(head);
    fitted.text = head + "...";
    needed = text_size(fitted.text, fitted.font_size).width;
  }
  return fitted;
}

}  // namespace insonify
