// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdlib>

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

double rounded(const double value, const int digits)
{
  return std::strtod(text(value, digits).c_str(), nullptr);
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

namespace
{
constexpr std::string_view base64_digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
} // namespace

std::string base64(const std::string &bytes)
{
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  for (std::size_t k = 0, at = 0; k < bytes.size(); k += 3, at += 4)
  {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 3; ++i)
      word = word << 8 | (i < n ? static_cast<unsigned char>(bytes[k + i]) : 0U);
    for (std::size_t i = 0; i <= n; ++i)
      text[at + i] = base64_digits[word >> (18 - 6 * i) & 63];
  }
  return text;
}

std::string from_base64(const std::string_view text)
{
  std::array<unsigned char, 256> value{};
  for (unsigned char k = 0; k < 64; ++k)
    value[static_cast<unsigned char>(base64_digits[k])] = k;
  std::string bytes(text.size() / 4 * 3, '\0');
  const auto *in = reinterpret_cast<const unsigned char *>(text.data());
  for (std::size_t k = 0; k < bytes.size(); k += 3, in += 4)
  {
    const unsigned int word =
        value[in[0]] << 18 | value[in[1]] << 12 | value[in[2]] << 6 | value[in[3]];
    bytes[k] = static_cast<char>(word >> 16);
    bytes[k + 1] = static_cast<char>(word >> 8);
    bytes[k + 2] = static_cast<char>(word);
  }
  return bytes;
}
} // namespace hpvi
