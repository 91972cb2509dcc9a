#include "fracture/peridynamics/pores_across.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace stockwork::peridynamics
{
using dealii::Tensor;

template <int dim>
LinearFunctional pores_across(const Zone<dim> &zone, const Segment<dim> &piece)
{
  LinearFunctional result;
  if constexpr (dim == 2)
  {
    constexpr double reach = 0.5; // of the piece; all lengths in spacings
    const Tensor<1, dim> &n = piece.normal, along = cross_product_2d(n);
    const Tensor<1, dim> centre = (piece.centre - zone.position(Place<dim>{})) / zone.spacing();
    std::map<unsigned int, double> weights; // by site
    double sum = 0.;
    const auto add_cell = [&](const Place<dim> &cell)
    {
      // What of the line lies in the cell.
      double begin = -10., end = 10.;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double low = cell[d] - centre[d], high = low + 1.;
        if (std::abs(along[d]) < same_place)
        {
          if (low > same_place || high < -same_place)
            return;
          continue;
        }
        begin = std::max(begin, std::min(low / along[d], high / along[d]));
        end = std::min(end, std::max(low / along[d], high / along[d]));
      }
      const double counted = std::min(end, reach) - std::max(begin, -reach);
      if (end - begin < same_place || counted <= 0.)
        return;
      for (unsigned int a = 0; a < 4; ++a)
      {
        Place<dim> corner = cell;
        for (unsigned int d = 0; d < dim; ++d)
          corner[d] += a >> d & 1;
        const unsigned int site = zone.find(corner);
        if (site == dealii::numbers::invalid_unsigned_int ||
            zone.sites()[site].pressure_dof == dealii::numbers::invalid_dof_index)
          continue;
        // int N_a n.grad(the jump), which is one on the side that the normal points to.
        double integral = 0.;
        for (unsigned int b = 0; b < 4; ++b)
        {
          double above = same_place;
          for (unsigned int d = 0; d < dim; ++d)
            above += n[d] * (cell[d] + static_cast<int>(b >> d & 1) - centre[d]);
          for (unsigned int d = 0; d < dim && above >= 0.; ++d)
            integral += n[d] * (b >> d & 1 ? 0.5 : -0.5) *
                        (((a ^ b) >> (1 - d) & 1) == 0 ? 1. / 3. : 1. / 6.);
        }
        weights[site] += counted / (end - begin) * integral;
        sum += counted / (end - begin) * integral;
      }
    };
    const int x = static_cast<int>(std::floor(centre[0])),
              y = static_cast<int>(std::floor(centre[1]));
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j)
        add_cell({{x + i, y + j}});
    for (const auto &[site, weight] : weights)
      if (weight != 0.)
      {
        result.bulk.push_back(zone.sites()[site].pressure_dof);
        result.bulk_coefficients.push_back(weight / sum);
      }
  }
  return result;
}

template LinearFunctional pores_across(const Zone<2> &, const Segment<2> &);
template LinearFunctional pores_across(const Zone<3> &, const Segment<3> &);
} // namespace stockwork::peridynamics
