#pragma once

#include <deal.II/base/function.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/types.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include "stockwork/base/error.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stockwork
{
/// A number, or a function of place and time, prescribed somewhere.
template <int dim>
struct PrescribedValue
{
  std::function<double(const dealii::Point<dim> &, double time)> value;
  bool constant_in_time = true;
};

/// Loads on the boundary, by side. Tractions are increments over the in-situ state.
template <int dim>
struct Loads
{
  /// Traction vector, one component per entry [Pa].
  std::map<dealii::types::boundary_id, std::array<PrescribedValue<dim>, dim>> traction;
  /// Normal traction, tension positive [Pa].
  std::map<dealii::types::boundary_id, PrescribedValue<dim>> normal_traction;
  /// Fluid flux into the rock [m/s].
  std::map<dealii::types::boundary_id, PrescribedValue<dim>> flux;

  /// On a side where it is the same everywhere, for reference solutions; throws InputError if the
  /// deck gives none.
  double uniform_normal_traction(const dealii::types::boundary_id side, const double time) const
  {
    const auto position = normal_traction.find(side);
    if (position == normal_traction.end())
      throw InputError(
        "The reference solution needs a load: 'Boundary conditions/Normal traction'.");
    return position->second.value(dealii::Point<dim>(), time);
  }

  bool empty() const
  {
    return traction.empty() && normal_traction.empty() && flux.empty();
  }

  bool constant_in_time() const
  {
    const auto is_constant = [](const PrescribedValue<dim> &load) { return load.constant_in_time; };
    const auto are_constant = [&](const auto &by_side)
    {
      return std::all_of(by_side.begin(), by_side.end(),
                         [&](const auto &side) { return is_constant(side.second); });
    };
    return are_constant(normal_traction) && are_constant(flux) &&
           std::all_of(traction.begin(), traction.end(),
                       [&](const auto &side) {
                         return std::all_of(side.second.begin(), side.second.end(), is_constant);
                       });
  }
};

/// A pressure that moves two other sides apart as given, see OpeningControl.
template <int dim>
struct ControlledLoad
{
  dealii::types::boundary_id loaded, from, to;
  PrescribedValue<dim> opening; ///< of time alone [m]
};

/// The boundary conditions of the deck, by named side.
template <int dim>
class BoundaryConditions
{
public:
  static void declare_parameters(dealii::ParameterHandler &prm);

  /// `side` maps a name to a boundary id and throws InputError for an unknown one.
  void parse_parameters(dealii::ParameterHandler &prm,
                        const std::function<dealii::types::boundary_id(const std::string &)> &side);

  /// The solution that the value `reference` in the deck refers to: components displacement, then
  /// pore pressure (over in situ); its time is set here. Needed before `constrain` if used.
  void set_reference(std::shared_ptr<dealii::Function<dim>> reference);

  /// The entry that asks for it, with its sections; empty where none does.
  const std::string &entry_with_reference() const
  {
    return reference_entry;
  }

  bool constant_in_time() const;

  /// The greatest component of displacement prescribed at a time, where it is the same along a side
  /// [m].
  double maximum_displacement(double time) const;

  /// Is there any condition on pore pressure or flux?
  bool mentions_pore_pressure() const;

  /// Whether a side is a roller, or fixed.
  bool is_roller(const dealii::types::boundary_id side) const;

  /// Whether a side is what a plane of symmetry across this coordinate is: it does not move across,
  /// and is free along.
  bool is_plane_of_symmetry(const dealii::types::boundary_id side,
                            const unsigned int coordinate) const;

  /// Whether a displacement other than none is prescribed on a side.
  bool moves(const dealii::types::boundary_id side) const;

  /// Whether neither fluid nor a change of volume gets through any of these sides.
  bool seal(const std::vector<dealii::types::boundary_id> &sides) const;

  /// Add hanging-node constraints and Dirichlet conditions at `time`; `increment` gets the same
  /// with zero values. Both are closed. Collective.
  void constrain(double time,
                 const dealii::Mapping<dim> &mapping,
                 const dealii::DoFHandler<dim> &dof_handler,
                 dealii::AffineConstraints<double> &values,
                 dealii::AffineConstraints<double> &increment) const;

  /// Whether each side with a condition is there on the mesh and, unless inertia resists, no rigid
  /// motion of the body is left. Collective.
  /// @throws EntryError naming the side, or the motion that is left
  void check(const dealii::Triangulation<dim> &triangulation, bool inertia) const;

  const Loads<dim> &loads() const
  {
    return prescribed_loads;
  }

  const std::optional<ControlledLoad<dim>> &controlled_load() const
  {
    return controlled;
  }

private:
  struct Dirichlet
  {
    dealii::types::boundary_id side;
    unsigned int component; ///< `normal_component`: found from the side's normal
    PrescribedValue<dim> prescribed;
    bool from_reference = false;
    std::string entry = {}; ///< of the deck, for messages
    std::string side_name = {};
    bool is_zero = false;
  };
  static constexpr unsigned int normal_component = 100;

  /// @throws EntryError where two conditions contradict one another and one would be dropped
  void refuse_contradictions(dealii::ParameterHandler &prm) const;

  /// A side that the deck names.
  struct Mention
  {
    dealii::types::boundary_id side;
    std::string entry, name;
  };

  void check_hold(const dealii::Triangulation<dim> &triangulation) const;

  /// @throws EntryError for a side with a normal traction that cannot move along its normal
  void refuse_idle_normal_tractions(const dealii::Triangulation<dim> &triangulation) const;

  std::vector<Mention> mentions;
  std::string rollers; ///< as the deck gives them
  std::vector<Dirichlet> dirichlet;
  Loads<dim> prescribed_loads;
  std::optional<ControlledLoad<dim>> controlled;
  std::shared_ptr<dealii::Function<dim>> reference;
  std::string reference_entry;
};
} // namespace stockwork
