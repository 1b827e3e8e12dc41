// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_drawing_h
#define hpvi_drawing_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** A place on a page and a direction there [pixels], y down. */
using PagePoint = dealii::Point<2>;
using PageVector = dealii::Tensor<1, 2>;

/** An upright rectangle on a page [pixels]. */
struct PageBox
{
  double left, top, right, bottom;

  double width() const
  {
    return right - left;
  }
  double height() const
  {
    return bottom - top;
  }
  bool overlaps(const PageBox &other) const;
  bool is_met_by(const PagePoint &from, const PagePoint &to) const; ///< by a line
};

/** A line of a text. */
struct TextLine
{
  std::string words;
  bool is_bold = false;
  std::string colour = "#000";
};

/** How wide a text is at most in a common font without serifs [pixels]. */
double text_width(const std::string &words, double font_size, bool is_bold);

enum class ArrowHead
{
  filled,
  open
};

/**
 * A picture as scalable vector graphics that grows with what is drawn: its page ends a little beyond the last mark.
 * It knows where marks and texts are, so that a text finds a place that is free.
 */
class Drawing
{
public:
  static constexpr double font_size = 12., line_height = 15.;

  /** All until end() belongs together: its classes, and the boundary whose mark it is. */
  void begin(const std::string &classes, const std::string &boundary = "");
  void end();

  /** @p style: attributes. An area is no obstacle for texts, a line is. */
  void area(const std::vector<PagePoint> &corners, const std::string &style);
  void line(const std::vector<PagePoint> &points, const std::string &style);
  void strokes(const std::vector<std::pair<PagePoint, PagePoint>> &ends, const std::string &style);
  void circle(const PagePoint &centre, double radius, const std::string &style);
  void arrow(const PagePoint &tail, const PagePoint &head, ArrowHead kind,
             const std::string &colour);

  /** A picture of pixels, a PNG in base64. */
  void image(const PageBox &box, const std::string &png);

  /** A text that looks for a place near another. */
  struct Note
  {
    PagePoint from;
    PageVector outward; ///< away from there, of length 1
    double aside;       ///< how far it may go across [pixels]
    std::vector<TextLine> lines;
    std::string classes, boundary; ///< as begin() has them
  };

  /** To be written by write_notes(), when all marks are drawn. */
  void add(const Note &note);

  /** Each as near as there is room, in turn; one that had to go far is led to by a thin line. */
  void write_notes();

  /** A text that begins ("start"), is centred ("middle") or ends ("end") at @p at. */
  void text_at(const PagePoint &at, const TextLine &line, const std::string &anchor = "start",
               double size = font_size);

  /** A text that is read from bottom to top, centred at @p at. */
  void text_upwards(const PagePoint &at, const std::string &words);

  const PageBox &extent() const; ///< of all that is drawn

  /** The file; @p head: what stands first in it, a comment. */
  std::string svg(const std::string &head) const;

private:
  void include(const PageBox &box);
  bool is_free(const PageBox &box) const;
  void write(const Note &note);

  std::ostringstream out;
  PageBox all{0, 0, 0, 0};
  bool is_empty = true;
  std::vector<Note> notes;
  std::vector<PageBox> texts;
  std::vector<std::pair<PagePoint, PagePoint>> lines;
};

/** Coordinates on a page, to a hundredth of a pixel. */
std::string on_page(const PagePoint &at);
} // namespace hpvi

#endif
