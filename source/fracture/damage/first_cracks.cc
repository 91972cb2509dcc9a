#include "fracture/damage/first_cracks.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace stockwork::damage
{
template <int dim>
std::vector<std::string> misfit_of_cells(const InitialCrack<dim> &crack,
                                         const std::vector<CrackCell<dim>> &passed,
                                         const double size,
                                         const bool pressure_is_given)
{
  std::vector<std::string> found;
  // The volume of a crack whose pressure is given goes with the square of its length.
  const double noticeable = pressure_is_given ? 0.004 : 0.02;
  if (dim == 2 && std::abs(size - crack.size()) > noticeable * crack.size())
  {
    std::ostringstream text;
    text << "A crack is " << size << " m long, not " << crack.size()
         << " m as in the deck: cracks of this model have whole cells.";
    found.push_back(text.str());
  }
  if (!crack.disc)
    return found;
  // Of a disc that planes of symmetry cut, the model has a part.
  const double wanted = dealii::numbers::PI * crack.disc->radius * crack.disc->radius,
               of_cell = passed.front().size();
  double misfit = 1.;
  for (const double share : {1., 0.5, 0.25, 0.125})
    misfit = std::min(misfit, std::abs(size / (share * wanted) - 1.));
  if (size > 1.02 * wanted || of_cell > 0.5 * crack.disc->radius ||
      (pressure_is_given && misfit > 0.01))
  {
    std::ostringstream text;
    text << "A disc of radius " << crack.disc->radius << " m, " << wanted << " m^2, is "
         << passed.size() << " whole cells of " << of_cell << " m here, " << size << " m^2.";
    found.push_back(text.str());
  }
  return found;
}


namespace
{
template <int dim>
std::string doubt_about_stairs(const std::vector<CrackCell<dim>> &cells)
{
  if (dim == 2 || std::all_of(cells.begin(), cells.end(),
                              [](const auto &cell) { return cell.is_cut_evenly(); }))
    return "";
  return "A crack is turned against the mesh, and grows more easily along the lines of the mesh in "
         "its plane than along its stairs of cells: discs turned by 27 and 45 degrees have become "
         "1.04 to 1.09 times as long as wide in viscous fluid, 1.12 to 1.22 times where toughness "
         "dominates, with up to 7 % less pressure than along the mesh. Turn the mesh, if you can, "
         "so that the crack lies along it.";
}


template <int dim>
std::string doubt_about_small_angles(const std::vector<CrackCell<dim>> &cells)
{
  if (dim == 2)
    for (const CrackCell<dim> &cell : cells)
      if (const double angle = cell.angle_to_mesh(); angle > 0.5 && angle < 12.)
      {
        std::ostringstream text;
        text << "A crack lies at " << std::setprecision(2) << angle
             << " degrees to the lines of the mesh. At such small angles cells crack one at a "
                "time, and the pressure rides on a sawtooth: that of 'kgd/rotated' ends up to 9 % "
                "off, along the mesh 3 %. Turn the mesh so that the crack lies along it, or take "
                "smaller cells.";
        return text.str();
      }
  return "";
}


template <int dim>
std::string doubt_about_flat_cells(const std::vector<CrackCell<dim>> &cells,
                                   const Scene<dim> &scene)
{
  double worst = 1.;
  for (const CrackCell<dim> &cell : cells)
  {
    if (!std::isnan(scene.rock(cell.region).tensile_strength))
      continue; // not taken for the size of a cell
    double longest = 0., shortest = std::numeric_limits<double>::infinity();
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double edge = (cell.face_centre(2 * d + 1) - cell.face_centre(2 * d)).norm();
      longest = std::max(longest, edge);
      shortest = std::min(shortest, edge);
    }
    worst = std::max(worst, longest / shortest);
  }
  if (worst < 2.)
    return "";
  std::ostringstream text;
  text << "Cells along a crack are " << std::setprecision(2) << worst
       << " times as long one way as another. The model takes them for squares of their size, in "
          "its strength and in how far a front goes: 'kgd/toughness' with cells four times as "
          "long as thick is 6 % off for 1 %. Make them square.";
  return text.str();
}
} // namespace


template <int dim>
std::vector<std::string> doubts_about_growth(const std::vector<CrackCell<dim>> &cells,
                                             const Scene<dim> &scene)
{
  std::vector<std::string> found;
  for (const std::string &doubt : {doubt_about_stairs(cells), doubt_about_small_angles(cells),
                                   doubt_about_flat_cells(cells, scene)})
    if (!doubt.empty())
      found.push_back(doubt);
  return found;
}


template std::vector<std::string>
misfit_of_cells<2>(const InitialCrack<2> &, const std::vector<CrackCell<2>> &, double, bool);
template std::vector<std::string>
misfit_of_cells<3>(const InitialCrack<3> &, const std::vector<CrackCell<3>> &, double, bool);
template std::vector<std::string> doubts_about_growth<2>(const std::vector<CrackCell<2>> &,
                                                         const Scene<2> &);
template std::vector<std::string> doubts_about_growth<3>(const std::vector<CrackCell<3>> &,
                                                         const Scene<3> &);
} // namespace stockwork::damage
