#pragma once

#include <deal.II/base/bounding_box.h>

#include <string>
#include <vector>

namespace stockwork
{
/// A box and what the deck says about it.
template <int dim>
struct LabelledBox
{
  std::string label;
  dealii::BoundingBox<dim> box;
};

/// Boxes from the deck, `label: (x, y[, z]) to (x, y[, z]); …` with lengths as quantities, in
/// the order given. An empty text is the empty list; a missing label stays empty.
/// @throws InputError
template <int dim>
std::vector<LabelledBox<dim>> parse_boxes(const std::string &text);

/// A box as a deck has it, "(0 m, -2 m) to (30 m, 2 m)", for messages.
template <int dim>
std::string to_string(const dealii::BoundingBox<dim> &box);

/// A point "x, y[, z]", with or without parentheses. @throws InputError
template <int dim>
dealii::Point<dim> parse_point(const std::string &text);
} // namespace stockwork
