// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/drawing.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace hpvi
{
namespace
{
std::string pixels(const double value)
{
  return text(std::round(100 * value) / 100 + 0., 10);
}

/** Is @p middle on the way, so that nobody sees whether it is there? */
bool is_between(const PagePoint &from, const PagePoint &middle, const PagePoint &to)
{
  const PageVector way = to - from, part = middle - from;
  return part * way > 0 && part * way < way * way &&
         std::abs(part[0] * way[1] - part[1] * way[0]) < 0.02 * way.norm();
}

/** Without points between others, all those since the last that is there: of a gentle curve each alone is between its neighbours. */
std::string path(const std::vector<PagePoint> &points)
{
  constexpr std::size_t most = 500; // so that a long line takes no more than its points
  std::string d;
  std::size_t last = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (k > 0 && k + 1 < points.size() && k - last < most &&
        std::all_of(points.begin() + last + 1, points.begin() + k + 1,
                    [&](const PagePoint &point)
                    { return is_between(points[last], point, points[k + 1]); }))
      continue;
    d += (k == 0 ? "M" : "L") + on_page(points[k]);
    last = k;
  }
  return d;
}

/** Around some points. */
PageBox box_of(const std::vector<PagePoint> &points)
{
  PageBox box{points[0][0], points[0][1], points[0][0], points[0][1]};
  for (const PagePoint &point : points)
    box = {std::min(box.left, point[0]), std::min(box.top, point[1]), std::max(box.right, point[0]),
           std::max(box.bottom, point[1])};
  return box;
}

/** In the class attribute and others. */
std::string attribute(const std::string &name, const std::string &value)
{
  return value.empty() ? "" : " " + name + "=\"" + xml_text(value) + '"';
}
} // namespace

std::string on_page(const PagePoint &at)
{
  return pixels(at[0]) + ' ' + pixels(at[1]);
}

bool PageBox::overlaps(const PageBox &other) const
{
  return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
}

/** What is left of the line within the box, side by side, is something. */
bool PageBox::is_met_by(const PagePoint &from, const PagePoint &to) const
{
  double begin = 0, end = 1;
  const auto clip = [&](const double start, const double way, const double low, const double high)
  {
    if (way == 0)
      return low < start && start < high;
    const double one = (low - start) / way, other = (high - start) / way;
    begin = std::max(begin, std::min(one, other));
    end = std::min(end, std::max(one, other));
    return begin < end;
  };
  return clip(from[0], to[0] - from[0], left, right) && clip(from[1], to[1] - from[1], top, bottom);
}

/** Those of DejaVu Sans, wider than most others. */
double text_width(const std::string &words, const double font_size, const bool is_bold)
{
  double width = 0;
  for (const unsigned char letter : words)
    width += letter >= 0xc0                              ? 1.
             : letter >= 0x80                            ? 0. // goes on with a letter
             : std::strchr(" .,:;'|!ijlftI()[]", letter) ? 0.4
             : std::strchr("mwMW%", letter)              ? 1.
             : std::strchr("=+<>~#", letter)             ? 0.84
             : letter >= 'A' && letter <= 'Z'            ? 0.76
                                                         : 0.64;
  return font_size * width * (is_bold ? 1.12 : 1.);
}

void Drawing::begin(const std::string &classes, const std::string &boundary)
{
  out << "<g" << attribute("class", classes) << attribute("data-boundary", boundary) << ">\n";
}

void Drawing::end()
{
  out << "</g>\n";
}

void Drawing::include(const PageBox &box)
{
  all = is_empty ? box
                 : PageBox{std::min(all.left, box.left), std::min(all.top, box.top),
                           std::max(all.right, box.right), std::max(all.bottom, box.bottom)};
  is_empty = false;
}

void Drawing::area(const std::vector<PagePoint> &corners, const std::string &style)
{
  out << "<path d=\"" << path(corners) << "Z\" " << style << "/>\n";
  include(box_of(corners));
}

void Drawing::line(const std::vector<PagePoint> &points, const std::string &style)
{
  out << "<path d=\"" << path(points) << "\" fill=\"none\" " << style << "/>\n";
  for (std::size_t k = 1; k < points.size(); ++k)
    lines.emplace_back(points[k - 1], points[k]);
  include(box_of(points));
}

void Drawing::strokes(const std::vector<std::pair<PagePoint, PagePoint>> &ends,
                      const std::string &style)
{
  out << "<path d=\"";
  for (const auto &[from, to] : ends)
  {
    out << path({from, to});
    include(box_of({from, to}));
  }
  out << "\" fill=\"none\" " << style << "/>\n";
  lines.insert(lines.end(), ends.begin(), ends.end());
}

void Drawing::circle(const PagePoint &centre, const double radius, const std::string &style)
{
  out << "<circle cx=\"" << pixels(centre[0]) << "\" cy=\"" << pixels(centre[1]) << "\" r=\""
      << pixels(radius) << "\" " << style << "/>\n";
  const PageVector right({radius, 0.}), down({0., radius});
  lines.emplace_back(centre - right, centre + right);
  lines.emplace_back(centre - down, centre + down);
  include({centre[0] - radius, centre[1] - radius, centre[0] + radius, centre[1] + radius});
}

/** A short arrow has a small head. Its path begins at the tail and ends at the head. */
void Drawing::arrow(const PagePoint &tail, const PagePoint &head, const ArrowHead kind,
                    const std::string &colour)
{
  const PageVector way = head - tail;
  const double length = way.norm(), size = std::min(8., 0.6 * length);
  if (length < 0.5)
    return;
  const PageVector along = way / length, across({-along[1], along[0]});
  const PagePoint neck = head - size * along;
  const PagePoint left = neck + 0.4 * size * across, right = neck - 0.4 * size * across;
  out << "<g class=\"arrow\">";
  line({tail, head - (kind == ArrowHead::filled ? 0.5 * size : 0.) * along},
       "class=\"shaft\" stroke=\"" + colour + "\" stroke-width=\"1.6\"");
  if (kind == ArrowHead::filled)
    area({left, head, right}, "class=\"head\" fill=\"" + colour + '"');
  else
    line({left, head, right}, "class=\"head\" stroke=\"" + colour + "\" stroke-width=\"1.6\"");
  out << "</g>\n";
}

void Drawing::image(const PageBox &box, const std::string &png)
{
  out << "<image x=\"" << pixels(box.left) << "\" y=\"" << pixels(box.top) << "\" width=\""
      << pixels(box.width()) << "\" height=\"" << pixels(box.height())
      << "\" href=\"data:image/png;base64," << png << "\"/>\n";
  include(box);
}

bool Drawing::is_free(const PageBox &box) const
{
  return std::none_of(texts.begin(), texts.end(),
                      [&](const PageBox &other) { return box.overlaps(other); }) &&
         std::none_of(lines.begin(), lines.end(),
                      [&](const auto &line) { return box.is_met_by(line.first, line.second); });
}

void Drawing::add(const Note &note)
{
  notes.push_back(note);
}

void Drawing::write_notes()
{
  for (const Note &note : notes)
    write(note);
  notes.clear();
}

namespace
{
PageVector size_of(const std::vector<TextLine> &lines)
{
  double width = 0;
  for (const TextLine &line : lines)
    width = std::max(width, text_width(line.words, Drawing::font_size, line.is_bold));
  return PageVector({width, Drawing::line_height * lines.size()});
}

/** The ways from a place that a text tries, the shortest first. */
std::vector<PageVector> ways(const PageVector &outward, const double aside)
{
  constexpr double step = 7., farthest = 420.;
  const PageVector across({-outward[1], outward[0]});
  std::vector<PageVector> result;
  for (double away = 4.; away < farthest; away += step)
    for (double side = 0.; side <= aside; side += step)
      for (const double sign : {1., -1.})
        result.push_back(away * outward + sign * side * across);
  std::stable_sort(result.begin(), result.end(),
                   [](const PageVector &one, const PageVector &other)
                   { return one.norm() < other.norm(); });
  return result;
}
} // namespace

void Drawing::write(const Note &note)
{
  const PageVector &outward = note.outward, half = 0.5 * size_of(note.lines);
  // as far as it takes to be beyond the place in the direction
  const PagePoint start =
      note.from + (half[0] * std::abs(outward[0]) + half[1] * std::abs(outward[1])) * outward;
  PageVector moved;
  PageBox box{};
  for (const PageVector &way : ways(outward, note.aside))
  {
    const PagePoint middle = start + way;
    moved = way;
    box = {middle[0] - half[0], middle[1] - half[1], middle[0] + half[0], middle[1] + half[1]};
    if (is_free({box.left - 3, box.top - 1, box.right + 3, box.bottom + 1}))
      break;
  }
  begin(note.classes, note.boundary);
  const PagePoint goal = note.from + moved;
  if (moved * outward > 60. &&
      std::none_of(texts.begin(), texts.end(),
                   [&](const PageBox &other) { return other.is_met_by(note.from, goal); }))
    line({note.from, goal}, "class=\"leader\" stroke=\"#999\" stroke-width=\"0.7\"");
  const bool begins = outward[0] > 0.5, ends = outward[0] < -0.5;
  PagePoint at(begins ? box.left
               : ends ? box.right
                      : (box.left + box.right) / 2,
               box.top + 0.8 * line_height);
  for (const TextLine &text_line : note.lines)
  {
    text_at(at, text_line, begins ? "start" : ends ? "end" : "middle");
    at[1] += line_height;
  }
  end();
}

/** With a rim of white, readable on lines as well. */
void Drawing::text_at(const PagePoint &at, const TextLine &line, const std::string &anchor,
                      const double size)
{
  out << "<text x=\"" << pixels(at[0]) << "\" y=\"" << pixels(at[1]) << "\" font-size=\""
      << pixels(size) << '"' << (line.is_bold ? " font-weight=\"bold\"" : "") << " text-anchor=\""
      << anchor << "\" fill=\"" << line.colour
      << "\" stroke=\"#fff\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\">"
      << xml_text(line.words) << "</text>\n";
  const double width = text_width(line.words, size, line.is_bold);
  const double left = at[0] - (anchor == "start" ? 0. : anchor == "end" ? width : width / 2);
  texts.push_back({left, at[1] - 0.85 * size, left + width, at[1] + 0.3 * size});
  include(texts.back());
}

void Drawing::text_upwards(const PagePoint &at, const std::string &words)
{
  const double half = text_width(words, font_size, false) / 2;
  out << "<text x=\"" << pixels(at[0]) << "\" y=\"" << pixels(at[1])
      << "\" text-anchor=\"middle\" transform=\"rotate(-90 " << on_page(at) << ")\">"
      << xml_text(words) << "</text>\n";
  texts.push_back({at[0] - font_size, at[1] - half, at[0] + 0.3 * font_size, at[1] + half});
  include(texts.back());
}

const PageBox &Drawing::extent() const
{
  return all;
}

std::string Drawing::svg(const std::string &head) const
{
  constexpr double margin = 12.;
  const double left = std::floor(all.left - margin), top = std::floor(all.top - margin);
  const double width = std::ceil(all.right + margin - left),
               height = std::ceil(all.bottom + margin - top);
  return "<!-- " + head + " -->\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
         pixels(width) + "\" height=\"" + pixels(height) + "\" viewBox=\"" + on_page({left, top}) +
         ' ' + on_page({width, height}) + "\" font-family=\"sans-serif\" font-size=\"" +
         pixels(font_size) + "\">\n<rect x=\"" + pixels(left) + "\" y=\"" + pixels(top) +
         "\" width=\"" + pixels(width) + "\" height=\"" + pixels(height) + "\" fill=\"#fff\"/>\n" +
         out.str() + "</svg>\n";
}
} // namespace hpvi
