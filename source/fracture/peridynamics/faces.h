#pragma once

#include "stockwork/exchange/segment.h"
#include "stockwork/exchange/sink.h"
#include "stockwork/exchange/state.h"

namespace stockwork::peridynamics
{
/// The faces of a segment with the pressure in the law of bonds. A traction that they have lost
/// strains the bonds across the fracture as a uniform stress of this traction strains the lattice;
/// by the transpose of that these bonds say what the faces have moved by. So there are two unknowns
/// of the model's own for each mode, across the fracture and, with friction, along it: the jump w,
/// and the lost traction q as a length y = gamma h q, with the strain gamma of the lattice under
/// unit pressure and the spacing h. Jumps are those over the face of a cell, A = h^(d-1): then w is
/// a volume, whatever becomes of the segment's area when it turns. With what the bonds say, V,
///
///   A (q - p_f + alpha dp_m + t_n) = 0,   (A w - V)/(gamma h) = 0
///
/// across it; along it there is no pressure. Stress in situ is lost besides. The jump across the
/// fracture, over the area of the segment, is its opening, so the network adds p_f; and of what the
/// strain of the elements makes room for, the pores lose alpha A w.
///
/// Faces whose bonds have broken do not pass through one another, and rub (Coulomb): the tractions
/// t that they exert on one another are
///
///   t_n = min(0, t_n + c (w - e (t_n - t_0))),   t_s = t_s + c (s - s_0), where |t_s| <= - mu t_n,
///   else at that bound,
///
/// any c > 0, with the slip s_0 of the last step and a little compliance e, or the pressure of
/// fluid that a closed fracture holds would hang on nothing. It counts from what presses the faces
/// in situ, t_0, or fluid that cannot get out would bear that from the beginning. Newton's method
/// for the complementarity, with the t on the right from the balance of forces (an active set;
/// Hueber and Wohlmuth 2005).
struct Faces
{
  struct Mode
  {
    unsigned int jump = 0, traction = 0; ///< numbers of w and y among the extra unknowns
    std::vector<double> of_ends;         ///< V by displacements of `ends` [m^(d-1)]
    std::vector<double> of_bonds;        ///< V by the unknowns of `bonds` [m^(d-1)]
    std::vector<double> of_tractions;    ///< V by q of each mode [m^d/Pa]
    double constant = 0.;                ///< V by the stress in situ [m^d]
  };

  std::uint64_t segment = 0;   ///< key
  double area = 0.;            ///< A [m^2]
  double unit = 0.;            ///< 1/(gamma h) [Pa/m]
  double friction = 0.;        ///< mu
  double in_situ_contact = 0.; ///< t_0 [Pa]
  bool rub = true;             ///< enough bonds have broken to tell opening from slip
  std::vector<Mode> modes;
  /// Displacements of ends of broken bonds, of state-based ones of all their families.
  std::vector<dealii::types::global_dof_index> ends;
  std::vector<double> in_situ;             ///< force of the stress in situ on them [N]
  std::vector<unsigned int> bonds;         ///< unknowns of those that soften
  const LinearFunctional *pores = nullptr; ///< their pressure on the faces; null: there are none
  double biot_coefficient = 0.;

  void assemble(const State &state, Sink &sink) const;

private:
  struct Rows;
  void add_contact(const State &state, Rows &rows) const;

  /// Forces on ends of broken bonds, and what these add to the jumps.
  void assemble_ends(const State &state, Sink &sink) const;

  /// What softening bonds add to the jumps.
  void assemble_bonds(Sink &sink) const;
};
} // namespace stockwork::peridynamics
