// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/formatting.h>

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

std::string json_string(const std::string &content)
{
  std::string result = "\"";
  for (const char c : content)
    if (c == '"' || c == '\\')
      result += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
    {
      const char digits[] = "0123456789abcdef";
      result += std::string("\\u00") + digits[c / 16] + digits[c % 16];
    }
    else
      result += c;
  return result + '"';
}

std::string xml_text(const std::string &content)
{
  std::string result;
  for (const char c : content)
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
