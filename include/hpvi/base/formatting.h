// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_formatting_h
#define hpvi_formatting_h

#include <string>
#include <string_view>

namespace hpvi
{
/** Of numbers that are read, not computed with. */
constexpr int shown_digits = 6;

/** The shortest decimal that reads back as the same number; the locale has no say. */
std::string text(double value);

/** Rounded to @p digits significant digits, for pictures and times. */
std::string text(double value, int digits);

std::string text(unsigned int value);

/** The number that text() then shows. */
double rounded(double value, int digits);

/**
 * @p content as UTF-8 that any reader takes: control characters become blanks, bytes that are no
 * UTF-8 the Latin-1 characters that they may have been.
 */
std::string legible(const std::string &content);

/** legible() in quotes, as JSON wants it. */
std::string json_string(const std::string &content);

/** legible() with the characters escaped that XML reserves. */
std::string xml_text(const std::string &content);

/** Bytes as text; that of nothing but blocks of three bytes may go on. deal.II's function takes several times as long. */
std::string base64(const std::string &bytes);

/** The bytes of base64(), with zeros to a multiple of three; of other texts there is no telling. */
std::string from_base64(std::string_view text);
} // namespace hpvi

#endif
