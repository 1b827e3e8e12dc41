// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/box_tree.h>

#include <deal.II/boost_adaptors/bounding_box.h>
#include <deal.II/boost_adaptors/point.h>
#include <deal.II/boost_adaptors/segment.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace hpvi
{
using namespace dealii;
namespace bgi = boost::geometry::index;

BoundingBox<2> box_around(const EdgePath &path)
{
  const Point<2> centre = path.point(0.5);
  double radius = 0;
  for (unsigned int k = 0; k <= 8; ++k)
    radius = std::max(radius, 1.01 * centre.distance(path.point(k / 8.)));
  const Tensor<1, 2> half({radius, radius});
  return BoundingBox<2>({centre - half, centre + half});
}

namespace
{
template <int dim>
using Numbered = std::pair<BoundingBox<dim>, unsigned int>;

template <int dim>
std::vector<Numbered<dim>> numbered(const std::vector<BoundingBox<dim>> &boxes)
{
  std::vector<Numbered<dim>> result;
  for (const BoundingBox<dim> &box : boxes)
    result.emplace_back(box, result.size());
  return result;
}

/** Ascending ones of what answers a query: where two are equal the order of the boxes decides, not that of the tree. */
template <int dim, class Query>
std::vector<unsigned int> numbers_of(const RTree<Numbered<dim>> &boxes, const Query &query)
{
  std::vector<unsigned int> result;
  for (const Numbered<dim> &box : boxes | bgi::adaptors::queried(query))
    result.push_back(box.second);
  std::sort(result.begin(), result.end());
  return result;
}
} // namespace

template <int dim>
struct BoxTree<dim>::Tree
{
  RTree<Numbered<dim>> boxes;
  BoundingBox<dim> all;
};

template <int dim>
BoxTree<dim>::BoxTree(const std::vector<BoundingBox<dim>> &boxes)
{
  BoundingBox<dim> all = boxes.front();
  for (const BoundingBox<dim> &box : boxes)
    all.merge_with(box);
  tree = std::make_shared<const Tree>(Tree{pack_rtree(numbered(boxes)), all});
}

template <int dim>
unsigned int BoxTree<dim>::nearest(const Point<dim> &x,
                                   const std::function<double(unsigned int)> &distance,
                                   const double hair) const
{
  std::vector<Numbered<dim>> first; // by its box
  tree->boxes.query(bgi::nearest(x, 1), std::back_inserter(first));
  Tensor<1, dim> reach;
  for (unsigned int d = 0; d < dim; ++d)
    reach[d] = (1 + 1e-6) * distance(first.front().second);
  double least = std::numeric_limits<double>::max();
  unsigned int result = 0;
  for (const unsigned int number :
       numbers_of<dim>(tree->boxes, bgi::intersects(BoundingBox<dim>({x - reach, x + reach}))))
    if (const double here = distance(number); here < (1 - hair) * least)
    {
      least = here;
      result = number;
    }
  return result;
}

template <int dim>
std::vector<unsigned int> BoxTree<dim>::along(const Point<dim> &x, const Tensor<1, dim> &n) const
{
  const auto &[lower, upper] = tree->all.get_boundary_points();
  const Tensor<1, dim> far = (x.distance(lower) + lower.distance(upper)) * n;
  return numbers_of<dim>(
      tree->boxes, bgi::intersects(boost::geometry::model::segment<Point<dim>>(x - far, x + far)));
}

template class BoxTree<2>;
template class BoxTree<3>;
} // namespace hpvi
