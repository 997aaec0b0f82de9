#include "scenes/type.h"

#include <vtkStdString.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <initializer_list>

namespace shoal::viz {
namespace {

constexpr int kDpi = 72;  // a point of type is a pixel

// The largest code point of a UTF-8 text outside General Punctuation and Mathematical Operators,
// of which VTK's font has what shoal-viz itself writes.
std::uint32_t farthest_letter(const std::string& text) {
  std::uint32_t farthest = 0;
  std::uint32_t letter = 0;
  for (const unsigned char byte : text) {
    if (byte < 0x80) {
      letter = byte;
    } else if (byte >= 0xC0) {
      letter = byte & (byte >= 0xF0 ? 0x07 : byte >= 0xE0 ? 0x0F : 0x1F);
      continue;
    } else {
      letter = letter << 6 | (byte & 0x3F);
    }
    const bool sign =
        (letter >= 0x2010 && letter < 0x2070) || (letter >= 0x2200 && letter < 0x2300);
    if (!sign) farthest = std::max(farthest, letter);
  }
  return farthest;
}

const char* first_there(std::initializer_list<const char*> paths) {
  for (const char* path : paths) {
    std::error_code code;
    if (std::filesystem::exists(path, code)) return path;
  }
  return nullptr;
}

// Greek to Arabic, and the scripts of East Asia.
const char* system_font(std::uint32_t letter) {
  static const char* const western = first_there({"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                                  "/usr/share/fonts/dejavu/DejaVuSans.ttf",
                                                  "/usr/share/fonts/TTF/DejaVuSans.ttf"});
  static const char* const eastern =
      first_there({"/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
                   "/usr/share/fonts/noto-cjk/NotoSansCJK-Regular.ttc",
                   "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf"});
  return letter >= 0x2E80 && eastern != nullptr ? eastern : western;
}

}  // namespace

void set_font(vtkTextProperty& property, const std::string& text) {
  constexpr std::uint32_t kLastOfVtksFont = 0x17F;
  property.SetFontFamilyToArial();
  const std::uint32_t letter = farthest_letter(text);
  if (letter <= kLastOfVtksFont) return;
  const char* font = system_font(letter);
  if (font == nullptr) return;
  property.SetFontFile(font);
  property.SetFontFamily(VTK_FONT_FILE);
}

double measured_width(const std::string& text, vtkTextProperty& property) {
  int box[4] = {0, -1, 0, -1};
  vtkTextRenderer::GetInstance()->GetBoundingBox(&property, vtkStdString(text), box, kDpi);
  return box[1] - box[0] + 1;
}

std::string shortened(const std::string& text, vtkTextProperty& property, double pixels) {
  if (measured_width(text, property) <= pixels) return text;
  std::string kept = text;
  while (!kept.empty()) {
    // A character of UTF-8 goes as a whole: its later bytes are 10xxxxxx.
    while (!kept.empty() && (static_cast<unsigned char>(kept.back()) & 0xC0) == 0x80) {
      kept.pop_back();
    }
    if (!kept.empty()) kept.pop_back();
    if (measured_width(kept + "...", property) <= pixels) return kept + "...";
  }
  return {};
}

}  // namespace shoal::viz
