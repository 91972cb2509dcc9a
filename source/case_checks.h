#pragma once

#include "case.h"

#include <string>
#include <vector>

namespace stockwork
{
// Each part of a deck may be sound, and what they say together not. All throw EntryError, but for
// those that only have something to say.

/// Where nothing gives way, neither rock nor fluid nor boundary, the level of the pore pressure is
/// anything, and what is injected has no place.
template <int dim>
void refuse_incompressible(dealii::ParameterHandler &prm,
                           const Rock &rock,
                           const Geometry<dim> &geometry,
                           const BoundaryConditions<dim> &boundary_conditions);

/// What a region may not have of its own, for the fracture model knows one strength or one rock
/// only. Pores, their fluid and the mass are the elements' everywhere.
void refuse_regions(dealii::ParameterHandler &prm,
                    const Rock &rock,
                    const std::string &model_name,
                    RegionalRock known_to_model);

/// Rock of a region that the mesh does not have would be nowhere.
template <int dim>
void refuse_absent_regions(dealii::ParameterHandler &prm, const Geometry<dim> &geometry);

/// Regions that the deck names and says nothing of.
template <int dim>
std::vector<std::string> regions_without_rock(dealii::ParameterHandler &prm,
                                              const Geometry<dim> &geometry);

/// What layers of the rock cannot be.
template <int dim>
void check_layers(dealii::ParameterHandler &prm, const RockLaws &laws, const Rock &rock);

/// The fluid in the pores of rock with a history is balanced from one step to the next.
template <int dim>
void check_history(dealii::ParameterHandler &prm, const Case<dim> &the_case);

/// Permeability that hangs on the stress, where nobody looks at it.
template <int dim>
void check_permeability(dealii::ParameterHandler &prm, const Case<dim> &the_case);

/// Rock that varies from place to place, where somebody takes it for uniform.
template <int dim>
void check_random_rock(dealii::ParameterHandler &prm,
                       const Case<dim> &the_case,
                       std::vector<std::string> &warnings);

/// What a reference solution cannot be of; @p warnings gets what it will not be near to.
template <int dim>
void check_reference(dealii::ParameterHandler &prm,
                     const Case<dim> &the_case,
                     std::vector<std::string> &warnings);

/// What flow in pores and in fractures cannot do without.
void require_for_flow(dealii::ParameterHandler &prm, bool in_pores, bool in_fractures);

/// What cracks cannot be in this body, with these wells and this leak-off.
template <int dim>
void check_cracks(const Case<dim> &the_case, std::vector<std::string> &warnings);

/// A fracture that conducts as a slot much wider than its crack opens.
template <int dim>
void check_minimum_aperture(const Case<dim> &the_case, std::vector<std::string> &warnings);

/// Vapour that opens a crack by itself.
template <int dim>
void check_vapour(dealii::ParameterHandler &prm,
                  const Case<dim> &the_case,
                  std::vector<std::string> &warnings);

/// What a scheme in time needs, and what it cannot be with.
template <int dim>
void check_scheme(const Deck &deck, dealii::ParameterHandler &prm, const Case<dim> &the_case);

/// Of 'Coupling/Scheme = as published'.
template <int dim>
void check_restarts(dealii::ParameterHandler &prm, const Case<dim> &the_case);
} // namespace stockwork
