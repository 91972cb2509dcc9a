// The pressure in state-based bonds: dilatations by the tractions that faces have lost, and what
// sites that have lost bonds lack of them.
#include "fracture/peridynamics/pressure_in_bonds.h"

#include <array>
#include <map>

namespace stockwork::peridynamics
{
using dealii::SymmetricTensor;
using dealii::Tensor;


template <int dim>
double PressureInBonds<dim>::dilatation(const unsigned int site,
                                        const unsigned int bond,
                                        const CellShares &shares,
                                        const std::vector<SymmetricTensor<2, dim>> &strain) const
{
  if constexpr (dim == 2)
    if (parameters.tracked && shares.empty())
    {
      const auto crossing = crossing_bonds.crossing(site, bond);
      return lattice.in_situ_is_zero || !crossing || paths.is_wet(crossing->path)
               ? 0.
               : trace(
                   lattice.dry_strain(site, bond, paths.point(*crossing), paths.left(*crossing)));
    }
  double dilatation = 0.;
  for (const auto &[cell, share] : shares)
    dilatation += share * trace(strain[cell]);
  return dilatation;
}


template <int dim>
double PressureInBonds<dim>::dilatation_of_traction(const unsigned int cell,
                                                    const unsigned int mode) const
{
  return trace(modes[cell][mode]) / (lattice.strain_of_pressure * lattice.zone.spacing());
}


template <int dim>
void PressureInBonds<dim>::add_dilatations(const std::vector<BondAcross<dim>> &across,
                                           ByDof &by_dof,
                                           ByUnknown &by_unknown)
{
  const unsigned int n = n_modes();
  std::map<unsigned int, std::vector<unsigned int>> broken_of; // bonds, by site
  for (const BondAcross<dim> &bond : across)
    if (lattice.bonds.is_broken(bond.view.first, bond.view.second))
      broken_of[bond.view.first].push_back(bond.view.second);
  std::map<unsigned int, std::vector<std::pair<unsigned int, double>>> soft_of; // and g, by site
  for (unsigned int number = 0; number < softening_bonds.size(); ++number)
    for (const auto &[s, b] : lattice.bonds.views_of(softening_bonds[number].view.first,
                                                     softening_bonds[number].view.second))
      soft_of[s].emplace_back(number, lattice.coefficients[b].dilatation);

  std::vector<unsigned int> family;
  std::vector<Tensor<1, dim>> functional;
  for (const auto &[i, broken] : broken_of)
  {
    const double share_of_site = lattice.share_that_lacks(i);
    if (share_of_site == 0.)
      continue; // others make up for what is missing
    // Of the strains of each cell, what broken bonds lack: as far as they belong to it, and all.
    // (As in add_broken(), what tractions do to the jumps of cells beside theirs is taken to be
    // theirs.)
    const auto lacks = [&](const unsigned int b, const Strain &strain)
    { return share_of_site * lattice.coefficients[b].dilatation * longer(i, b, strain); };
    std::map<unsigned int, std::array<double, 3>> own;
    for (const unsigned int b : broken)
      for (const auto &[cell, share] : shares(i, b, true))
        if (faces_of[cell] != nullptr)
        {
          std::array<double, 3> &of_cell = own.try_emplace(cell).first->second;
          for (unsigned int m = 0; m < n; ++m)
            of_cell[m] += share * lacks(b, modes[cell][m]);
          if (!lattice.in_situ_is_zero)
            of_cell[2] += share * lacks(b, released[cell]);
        }
    if (own.empty())
      continue;
    const double modulus = lattice.find_dilatation(i, family, functional);
    for (const auto &[cell, of_cell] : own)
    {
      for (unsigned int k = 0; k < family.size(); ++k)
        for (unsigned int d = 0; d < dim && functional[k].norm_square() > 0.; ++d)
        {
          auto &of_dof = by_dof[cell][lattice.zone.sites()[family[k]].dofs[d]];
          for (unsigned int m = 0; m < of_dof.size(); ++m)
            of_dof[m] += modulus * of_cell[m] * functional[k][d];
        }
      for (unsigned int m = 0; m < n; ++m)
      {
        Faces::Mode &mode = faces_of[cell]->modes[m];
        for (const unsigned int b : broken)
        {
          for (unsigned int k = 0; k < n; ++k)
            mode.of_tractions[k] -= modulus * of_cell[m] * lacks(b, modes[cell][k]);
          if (!lattice.in_situ_is_zero)
            mode.constant -= modulus * of_cell[m] * lacks(b, released[cell]);
        }
      }
      if (const auto soft = soft_of.find(i); soft != soft_of.end())
        for (const auto &[number, g] : soft->second)
          for (unsigned int m = 0; m < n; ++m)
            by_unknown[cell][number][m] -= modulus * of_cell[m] * g;
    }
  }
}


template <int dim>
double PressureInBonds<dim>::lacked_dilatation(const unsigned int site,
                                               const std::vector<Strain> &strain) const
{
  double sum = 0.;
  for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
    if (lattice.bonds.is_broken(site, b))
      for (const auto &[cell, share] : shares(site, b, true))
        sum += share * lattice.coefficients[b].dilatation * longer(site, b, strain[cell]);
  return sum;
}


template <int dim>
std::vector<std::pair<unsigned int, double>>
PressureInBonds<dim>::lacked_by_tractions(const unsigned int site) const
{
  const double unit = 1. / (lattice.strain_of_pressure * lattice.zone.spacing());
  std::vector<std::pair<unsigned int, double>> result;
  for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
    if (lattice.bonds.is_broken(site, b))
      for (const auto &[cell, share] : shares(site, b, true))
        for (unsigned int m = 0; m < n_modes(); ++m)
          result.emplace_back(unknown_of_traction(cell, m),
                              share * lattice.coefficients[b].dilatation * unit *
                                longer(site, b, modes[cell][m]));
  return result;
}


#define INSTANTIATE(dim)                                                                           \
  template double PressureInBonds<dim>::dilatation(unsigned int, unsigned int, const CellShares &, \
                                                   const std::vector<SymmetricTensor<2, dim>> &)   \
    const;                                                                                         \
  template double PressureInBonds<dim>::dilatation_of_traction(unsigned int, unsigned int) const;  \
  template double PressureInBonds<dim>::lacked_dilatation(                                         \
    unsigned int, const std::vector<SymmetricTensor<2, dim>> &) const;                             \
  template std::vector<std::pair<unsigned int, double>> PressureInBonds<dim>::lacked_by_tractions( \
    unsigned int) const;                                                                           \
  template void PressureInBonds<dim>::add_dilatations(const std::vector<BondAcross<dim>> &,        \
                                                      ByDof &, ByUnknown &);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
