#pragma once

#include "stockwork/exchange/scene.h"

#include <string>

namespace stockwork
{
/// What fracture models ask of a scene alike. Each throws an InputError, with what the deck may say
/// instead, where the scene is not so. @p model is the name that the deck knows.
namespace needs
{
/// A crack to begin with.
/// @param otherwise what the model can do without it, as the end of the sentence: "or a box"
template <int dim>
void initial_crack(const Scene<dim> &scene,
                   const std::string &model,
                   const std::string &otherwise = "");

/// Cracks without proppant between their faces.
template <int dim>
void cracks_without_proppant(const Scene<dim> &scene, const std::string &model);

/// Cracks without strength and without proppant.
template <int dim>
void open_cracks(const Scene<dim> &scene, const std::string &model);

/// The energy that a new crack costs; @p otherwise as above.
void energy_release_rate(const Rock &rock,
                         const std::string &model,
                         const std::string &otherwise = "");

/// That energy is the same whether a crack opens or slides.
/// @param why the end of a sentence about the model: "whose cracks have one energy"
/// @param path of the rock's subsection
void energy_of_all_modes(const RockProperties &rock,
                         const std::string &model,
                         const std::string &why,
                         const std::string &path = "Rock");

/// A strength that the deck leaves to the model.
/// @param why as above: "where the strength follows from the cells' size"
void no_given_strength(const RockProperties &rock,
                       const std::string &model,
                       const std::string &why,
                       const std::string &path = "Rock");
} // namespace needs
} // namespace stockwork
