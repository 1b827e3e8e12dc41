// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>

#include <algorithm>
#include <charconv>

namespace hpvi
{
std::string text(const double value)
{
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string text(const double value, const int digits)
{
  char buffer[64];
  return {
      buffer,
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr};
}

std::string text(const unsigned int value)
{
  return std::to_string(value);
}

namespace
{
void append_utf8(std::string &result, const char32_t c)
{
  const unsigned int n_more = c < 0x80 ? 0 : c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
  const unsigned int marks[] = {0, 0xc0, 0xe0, 0xf0};
  result += static_cast<char>(marks[n_more] | c >> 6 * n_more);
  for (unsigned int k = n_more; k > 0; --k)
    result += static_cast<char>(0x80 | (c >> 6 * (k - 1) & 0x3f));
}
} // namespace

std::string legible(const std::string &content)
{
  std::string result;
  for (std::size_t i = 0; i < content.size();)
  {
    const Character character = character_at(content, i);
    const char32_t c =
        character.length > 0 ? character.code : static_cast<unsigned char>(content[i]);
    i += std::max<std::size_t>(character.length, 1);
    const bool control = c < 0x20 || (c >= 0x7f && c < 0xa0);
    const bool no_character = c == 0xfffe || c == 0xffff;
    append_utf8(result, control ? U' ' : no_character ? U'\xfffd' : c);
  }
  return result;
}

std::string json_string(const std::string &content)
{
  std::string result = "\"";
  for (const char c : legible(content))
  {
    if (c == '"' || c == '\\')
      result += '\\';
    result += c;
  }
  return result + '"';
}

std::string xml_text(const std::string &content)
{
  std::string result;
  for (const char c : legible(content))
    switch (c)
    {
    case '&':
      result += "&amp;";
      break;
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    case '"':
      result += "&quot;";
      break;
    default:
      result += c;
    }
  return result;
}
} // namespace hpvi
