#include <isochor/space/point_location.h>

#include <deal.II/numerics/rtree.h>

#include <limits>

namespace isochor
{
  namespace
  {
    namespace Index = boost::geometry::index;

    // Boxes overlap, and the box nearest to a point outside the body need not be that of the
    // nearest cell.
    constexpr unsigned int n_nearby = 20;

    template <int dim>
    using Box = std::pair<dealii::BoundingBox<dim>, LocalIndex>;

    template <int dim>
    std::vector<Box<dim>> boxes(const CellTables<dim> &cells)
    {
      std::vector<Box<dim>> boxes;
      for (LocalIndex cell = 0; cell < cells.n_owned; ++cell)
        {
          auto lower = cells.vertex(cell, 0), upper = lower;
          for (unsigned int i = 1; i < cells.n_g; ++i)
            for (unsigned int d = 0; d < dim; ++d)
              {
                lower[d] = std::min(lower[d], cells.vertex(cell, i)[d]);
                upper[d] = std::max(upper[d], cells.vertex(cell, i)[d]);
              }
          boxes.emplace_back(dealii::BoundingBox<dim>({lower, upper}), cell);
        }
      return boxes;
    }
  } // namespace

  template <int dim>
  dealii::Point<dim> reference_point(const CellTables<dim>    &cells,
                                     const std::size_t         cell,
                                     const dealii::Point<dim> &point)
  {
    auto xi = reference_centre<dim>(cells.kind);
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        const dealii::Tensor<1, dim> step
            = cells.map(cell, xi).inverse * (point - cells.position(cell, xi));
        xi += step;
        if (cells.is_affine[cell] || step.norm() < 1e-12 || !(xi.norm() < 10))
          break;
      }
    return xi;
  }

  template <int dim>
  double depth(const CellKind kind, const dealii::Point<dim> &xi)
  {
    double least = 1., sum = 0;
    for (unsigned int d = 0; d < dim; ++d)
      {
        least = std::min(least, xi[d]);
        sum += xi[d];
        if (kind == CellKind::hypercube)
          least = std::min(least, 1. - xi[d]);
      }
    return kind == CellKind::simplex ? std::min(least, 1. - sum) : least;
  }

  template <int dim>
  struct PointLocation<dim>::Tree
  {
    dealii::RTree<Box<dim>> boxes;
  };

  template <int dim>
  PointLocation<dim>::PointLocation(const CellTables<dim> &cells)
    : cells(cells)
    , tree(std::make_unique<const Tree>(Tree{dealii::pack_rtree(boxes(cells))}))
  {
  }

  template <int dim>
  PointLocation<dim>::~PointLocation() = default;

  template <int dim>
  std::optional<typename PointLocation<dim>::Place>
  PointLocation<dim>::locate(const dealii::Point<dim> &point) const
  {
    std::optional<Place> best;
    const auto           consider = [&](const auto &query) {
      for (auto hit = tree->boxes.qbegin(query); hit != tree->boxes.qend(); ++hit)
        {
          const auto   xi     = reference_point(cells, hit->second, point);
          const double inside = depth(cells.kind, xi);
          if (!best || inside > best->depth)
            best = Place{hit->second, xi, inside};
        }
    };
    consider(Index::intersects(point));
    if (!best || best->depth < -1e-9)
      consider(Index::nearest(point, n_nearby));
    return best;
  }

  template dealii::Point<2>
  reference_point(const CellTables<2> &, std::size_t, const dealii::Point<2> &);
  template dealii::Point<3>
                  reference_point(const CellTables<3> &, std::size_t, const dealii::Point<3> &);
  template double depth(CellKind, const dealii::Point<2> &);
  template double depth(CellKind, const dealii::Point<3> &);
  template class PointLocation<2>;
  template class PointLocation<3>;
} // namespace isochor
