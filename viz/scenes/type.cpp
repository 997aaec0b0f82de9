#include "scenes/type.h"

#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "core/utf8.h"

namespace shoal::viz {
namespace {

constexpr int kDpi = 72;                         // a point of type is a pixel
constexpr const char* kBox = "\u25A1";           // WHITE SQUARE, for a letter that cannot be drawn
constexpr const char* kNoLetter = "\U0010FFFD";  // for private use, and used by no font

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

// Letters of which nothing is drawn though a font may have them: spaces, joiners, and what chooses
// a variant of the letter before. UTF-8 sorts as the code points do.
bool is_blank(const std::string& letter) {
  constexpr struct {
    std::string_view first;
    std::string_view last;
  } kBlank[] = {{"\u00A0", "\u00A0"}, {"\u00AD", "\u00AD"}, {"\u2000", "\u200F"},
                {"\u2028", "\u202F"}, {"\u205F", "\u206F"}, {"\u3000", "\u3000"},
                {"\uFE00", "\uFE0F"}, {"\uFEFF", "\uFEFF"}, {"\U000E0000", "\U000E01FF"}};
  return std::ranges::any_of(
      kBlank, [&](const auto& range) { return letter >= range.first && letter <= range.last; });
}

// Where each character of a UTF-8 text begins, and where the last one ends. Later bytes of one are
// 10xxxxxx.
std::vector<std::size_t> letters_of(const std::string& text) {
  std::vector<std::size_t> letters;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) letters.push_back(i);
  }
  letters.push_back(text.size());
  return letters;
}

// How many characters the last " (" and all behind it are; 0 where there is none.
std::size_t variant_letters(const std::string& text, const std::vector<std::size_t>& letters) {
  const auto begin = std::ranges::lower_bound(letters, text.rfind(" ("));
  return begin == letters.end() ? 0 : static_cast<std::size_t>(letters.end() - begin) - 1;
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

std::string drawable(const std::string& text, vtkTextProperty& property) {
  vtkNew<vtkTextProperty> large;  // so that no letter is as narrow as nothing
  large->ShallowCopy(&property);
  large->SetFontSize(64);
  const double nothing = measured_width(kNoLetter, *large);
  const auto is_there = [&](const std::string& letter) {
    return is_blank(letter) || measured_width(letter, *large) > nothing;
  };
  std::string drawn;
  for (std::size_t at = 0; at < text.size();) {
    const std::string letter(utf8_character_at(text, at));  // empty: a byte that is none
    const bool is_ascii = letter.size() == 1;
    if (is_ascii || (!letter.empty() && is_there(letter))) {
      drawn += letter;
    } else {
      drawn += is_there(kBox) ? kBox : "?";
    }
    at += std::max<std::size_t>(1, letter.size());
  }
  return drawn;
}

double measured_width(const std::string& text, vtkTextProperty& property) {
  int box[4] = {0, -1, 0, -1};
  vtkTextRenderer::GetInstance()->GetBoundingBox(&property, vtkStdString(text), box, kDpi);
  return box[1] - box[0] + 1;
}

std::string shortened(const std::string& text, vtkTextProperty& property, double pixels,
                      TextCut cut) {
  if (measured_width(text, property) <= pixels) return text;
  const std::vector<std::size_t> letters = letters_of(text);
  const std::size_t count = letters.size() - 1;
  const auto joined = [&](std::size_t head, std::size_t tail) {
    return text.substr(0, letters[head]) + "..." + text.substr(letters[count - tail]);
  };
  const auto fits = [&](std::size_t head, std::size_t tail) {
    return measured_width(joined(head, tail), property) <= pixels;
  };
  if (const std::size_t tail = cut == TextCut::middle ? variant_letters(text, letters) : 0;
      tail > 0 && fits(0, tail)) {
    std::size_t head = count - tail;
    while (!fits(head, tail)) --head;
    return joined(head, tail);
  }
  for (std::size_t kept = count; kept-- > 0;) {
    const std::size_t tail = cut == TextCut::middle ? kept / 2 : 0;
    if (fits(kept - tail, tail)) return joined(kept - tail, tail);
  }
  return {};
}

}  // namespace shoal::viz
