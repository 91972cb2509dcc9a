#pragma once

#include "fracture/peridynamics/crossed_cells.h"
#include "fracture/peridynamics/crossing_bonds.h"
#include "fracture/peridynamics/faces.h"
#include "fracture/peridynamics/fracture.h"
#include "fracture/peridynamics/lattice.h"
#include "fracture/peridynamics/softening_bonds.h"
#include "fracture/peridynamics/tracked_paths.h"
#include "stockwork/exchange/extra_unknown.h"

#include <array>
#include <map>
#include <vector>

namespace stockwork::peridynamics
{
/// `Closure = in bonds`: the fluid's pressure is part of the law of bonds. A crack under a net
/// pressure p is one without load in rock under a uniform stress p, less the uniform field. So what
/// counts for a bond of length l is its elongation under both, the effective one
///
///   e* = e + l p / (C11 + (d-1) C12),
///
/// in which it softens and breaks; and its force is k (e - D e*): none of the pressure while it is
/// whole, a push of k l p / (C11 + (d-1) C12) on its ends when it is broken. The volume adjoint to
/// that is the sum of k l D e* / (C11 + (d-1) C12), and each bond's goes to the cell where it
/// crosses the fracture. What stress in situ acts on the plane of the fracture belongs to p; what
/// shear does, is a uniform field of its own.
///
/// Of state-based bonds the dilatations are those of the rock under that stress, too: theta* = sum
/// g (1 - D) e*, over what is left of the bonds. So faces read the lost force of dilatations k y =
/// D A V g (theta* + theta'*) besides, k l y / (C11 + (d-1) C12), and of both ends A V g D e* d /
/// (C11 + (d-1) C12); and sites lack what broken bonds would have of the uniform expansion. It is
/// exact where moduli of regions are in one ratio; where Poisson's ratios differ, a uniform
/// pressure strains them by other than a uniform stress would.
template <int dim>
class PressureInBonds
{
public:
  /// @param softening_bonds,paths,crossing_bonds,fracture as they are whenever something is asked
  PressureInBonds(const Lattice<dim> &lattice,
                  const SofteningBonds<dim> &softening_bonds,
                  const TrackedPaths &paths,
                  const CrossingBonds<dim> &crossing_bonds,
                  Fracture<dim> &fracture);

  /// The cells are others. Needed where only shares() is asked for, see follow().
  void find_crossed();

  /// The fracture is another: its segments open by what bonds have lost of their elongation.
  void follow();

  /// Modes in which faces have unknowns: across the fracture, and along it if they rub.
  unsigned int n_modes() const
  {
    return lattice.parameters.friction > 0. ? 2 : 1;
  }

  /// The unknowns of all cells. They follow those of the softening bonds.
  std::vector<ExtraUnknown> unknowns() const;

  /// Number of the traction of a cell's faces among the extra unknowns; that of the jump is the one
  /// before. See Faces.
  unsigned int unknown_of_traction(const unsigned int cell, const unsigned int mode) const
  {
    return softening_bonds.n_unknowns() + 2 * (cell * n_modes() + mode) + 1;
  }

  /// Of all cells, strain of the lattice by the tractions that their faces have lost.
  std::vector<dealii::SymmetricTensor<2, dim>> strain(const State &state) const;

  /// Of a bond that holds, the stretch that it would have by the tractions that the faces have lost
  /// of the cells that it belongs to.
  /// @param strain see above
  double stretch(unsigned int site,
                 unsigned int bond,
                 const CellShares &shares,
                 const std::vector<dealii::SymmetricTensor<2, dim>> &strain) const;

  /// The same of a bond, by its number in the stencil, across one cell by a unit of the unknown of
  /// its traction.
  double stretch_of_traction(unsigned int cell, unsigned int mode, unsigned int bond) const;

  /// The trace of the same strain: the dilatation that both of a bond's ends would have.
  double dilatation(unsigned int site,
                    unsigned int bond,
                    const CellShares &shares,
                    const std::vector<dealii::SymmetricTensor<2, dim>> &strain) const;

  /// Of a bond's ends, across one cell, by a unit of the unknown of its traction.
  double dilatation_of_traction(unsigned int cell, unsigned int mode) const;

  /// Of a site, the dilatation that its broken bonds would have by those tractions, and do not.
  double lacked_dilatation(unsigned int site,
                           const std::vector<dealii::SymmetricTensor<2, dim>> &strain) const;

  /// The same by the unknowns of the tractions, which may come more than once.
  std::vector<std::pair<unsigned int, double>> lacked_by_tractions(unsigned int site) const;

  /// By what a broken bond is longer by a stress that strains the lattice so, the more the softer
  /// it is [m].
  double
  longer(unsigned int site, unsigned int bond, const dealii::SymmetricTensor<2, dim> &strain) const;

  /// Of a bond across a path that fluid has not reached: by the effective in-situ traction there,
  /// which the fracture would release.
  double dry_stretch(unsigned int site, unsigned int bond) const;

  /// The fracture cells that a bond belongs to, see CrossedCells, or the pieces of a path.
  /// @param always of a bond that has lost something; else only where it feels the fluid
  CellShares shares(unsigned int site, unsigned int bond, bool always) const;

  /// The same of a softening bond, by its number.
  const CellShares &shares(const unsigned int softening_bond) const
  {
    return softening_shares[softening_bond];
  }

  /// What faces do. See Faces.
  void assemble(const State &state, Sink &sink) const;

  /// Whether faces touch anywhere.
  bool touches(const State &state) const;

  /// What the faces of a cell have slid by, in the mean over its segment [m]. With friction only,
  /// for what slides freely has no unknown of its own.
  double slip(unsigned int cell, const State &state) const;

  /// Work of friction in the step that has led to a state [J/m].
  double work_of_friction(const State &state) const;

private:
  using Strain = dealii::SymmetricTensor<2, dim>;

  /// Strain that the lattice has by the in-situ stress on a cell's plane.
  Strain released_strain(unsigned int cell) const;

  /// Of all cells, the same of unit tractions of the modes [1/Pa]: across the fracture and along
  /// it, combined so that bonds read no slip as an opening, nor the other way round.
  void find_modes(const std::vector<BondAcross<dim>> &across);

  /// Of all cells: of the bonds across a piece, the share that is broken.
  std::vector<double> broken_shares(const std::vector<BondAcross<dim>> &across) const;

  /// Faces and segments of this rank, but for what bonds do to them.
  void make_faces(const std::vector<double> &broken_share);

  /// Of each cell and unknown of a softening bond, what it adds to the jumps.
  using ByUnknown = std::vector<std::map<unsigned int, std::array<double, 2>>>;

  /// What broken bonds add to their jumps, and the force of the stress in situ.
  void add_broken(const std::vector<BondAcross<dim>> &across, ByUnknown &by_unknown);

  /// What softening bonds add to their jumps.
  void add_softening(ByUnknown &by_unknown);

  /// Of each cell and dof at an end of its bonds, what it adds to the jumps, and the force of the
  /// stress in situ.
  using ByDof = std::vector<std::map<dealii::types::global_dof_index, std::array<double, 3>>>;

  /// What broken bonds do by the dilatations of their ends, if they are state-based: in rock under
  /// the traction these would not have the broken bonds' part of it.
  void
  add_dilatations(const std::vector<BondAcross<dim>> &across, ByDof &by_dof, ByUnknown &by_unknown);

  /// Of segments on pieces that fluid has reached within the step: what bonds there read before,
  /// under the traction of the piece that they belonged to. Brittle bonds read nothing before they
  /// break.
  void find_room_before();

  /// Force on one end of a bond by the stress that strains the lattice so; by a strain per
  /// traction, of which a jump of its ends reads this for each metre of elongation [m^(d-1)].
  double pull(unsigned int site,
              unsigned int bond,
              const dealii::Tensor<1, dim> &direction,
              const Strain &strain) const;

  /// Those that cross a path; without paths the broken ones.
  std::vector<BondAcross<dim>> bonds_across() const;

  /// shares() for what a cell's faces have moved by: bonds ahead of the fluid belong to its last
  /// piece, but not to that one's jump.
  CellShares shares_of_jump(const BondAcross<dim> &bond) const;

  /// Whether brittle bonds feel a given pressure: one of the two sites has a broken bond, as in
  /// ExplicitBonds. That is the same in all directions, and so does not keep a fracture straight,
  /// as it does to count bonds across the plane ahead of its tip only.
  bool is_wet_bond(const unsigned int site, const unsigned int bond) const
  {
    return lattice.damage[site] > 0. || lattice.damage[lattice.zone.far_end(site, bond).site] > 0.;
  }

  /// Of a piece in porous rock, see Segment [m].
  double bare_aperture(unsigned int cell) const;

  const Lattice<dim> &lattice;
  const Parameters<dim> &parameters;
  const Scene<dim> &scene;
  const SofteningBonds<dim> &softening_bonds;
  const TrackedPaths &paths;
  const CrossingBonds<dim> &crossing_bonds;
  Fracture<dim> &fracture;

  CrossedCells<dim> crossed;
  std::vector<Strain> released;                  ///< of each cell, if not all zero
  std::vector<std::array<Strain, 2>> modes;      ///< of each cell, see find_modes()
  std::vector<LinearFunctional> pores_of_pieces; ///< of each cell, see pores_across()
  std::vector<Faces> faces;                      ///< of owned segments
  std::vector<Faces *> faces_of;                 ///< of each cell; null: another rank's
  std::vector<CellShares> softening_shares;      ///< of the softening bonds
};
} // namespace stockwork::peridynamics
