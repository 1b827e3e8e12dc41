// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>

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
/** The character that starts at @p i, which moves behind it; what is no UTF-8 is taken as Latin-1. */
char32_t next_character(const std::string &content, std::size_t &i)
{
  const auto byte = [&content](const std::size_t k) -> unsigned char
  { return k < content.size() ? content[k] : 0; };
  const unsigned char first = byte(i++);
  const unsigned int n_more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
  char32_t c = n_more == 0 ? first : first & (0x3f >> n_more);
  for (unsigned int k = 0; k < n_more; ++k)
  {
    if ((byte(i + k) & 0xc0) != 0x80)
      return first;
    c = c << 6 | (byte(i + k) & 0x3f);
  }
  const char32_t lowest[] = {0, 0x80, 0x800, 0x10000}; // of this length
  if (first >= 0xf8 || c < lowest[n_more] || c > 0x10ffff || (c >= 0xd800 && c < 0xe000))
    return first;
  i += n_more;
  return c;
}

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
    const char32_t c = next_character(content, i);
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
