#pragma once

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <vector>

#include "flow/conductivity.h"
#include "stockwork/exchange/segment.h"
#include "stockwork/exchange/sink.h"
#include "stockwork/exchange/state.h"

namespace stockwork
{
/// The other way to carry fluid along a fracture: no network, but elements of the pore pressure
/// that conduct as much as the fracture in them does. In a cell of volume V that the fracture
/// passes with area A and normal n, its height across is h = V/A and its permeability
///
///   k_n n n + k_l (I - n n),  k_n = k,  k_l = k + w^3/(12 h)
///
/// (Zhang et al. 2022, Eqs. 26 to 29, where 1/h is missing; Sun et al. 2021, Eqs. 16 and 17, print
/// w^2/12, by h/w too much). k is the rock's and its elements' affair, so that only the second part
/// of k_l is added here.
///
/// Fluid between two faces has one pressure across them. The formula does not say so, and where n
/// is oblique to the mesh the vertices on both sides then part with one another and the cells with
/// their neighbours: of what the cubic law says, a band at 15, 30, 45 degrees conducts 0, 0, 49 %.
/// So that the mean of the pressure's gradient over the cell lies along the fracture, `across`
/// times as much is conducted by it across; 98 to 100 % then, at any angle. Along the mesh nothing
/// changes.
///
/// Segments have no neighbours then, and no drop of pressure to the pores:
/// their pressure is the mean of their cell's. Their opening, their volume, their load on the rock
/// and the wells stay the network's.
namespace permeability_tensor
{
/// Entry "Fluid" of a fracture model.
void declare_parameters(dealii::ParameterHandler &prm);

/// Whether the model's subsection, in which the handler is, asks for it.
bool is_chosen(dealii::ParameterHandler &prm);

/// What holds for all fluid in fractures then. The handler is at the root.
/// @param entry that chooses it, with its section
/// @return the minimum aperture [m]
/// @throws EntryError
double parse_fracture_flow(dealii::ParameterHandler &prm, const std::string &entry);


/// The functions of the pore pressure in a cell, at the points that integrals over it are sums of.
template <int dim>
struct Cell
{
  static constexpr unsigned int n_functions = 1 << dim;

  struct At
  {
    double weight; ///< [m^dim]
    std::array<double, n_functions> value;
    std::array<dealii::Tensor<1, dim>, n_functions> gradient; ///< [1/m]
  };
  std::vector<At> points;
  double volume = 0.; ///< [m^dim]

  explicit Cell(const std::array<dealii::Point<dim>, n_functions> &vertices);
};


/// How much better than along it a fracture conducts by the mean gradient in a cell across it.
constexpr double across = 100.;

/// What flows along the fracture in a segment's cell, for the rows of the pore pressure.
/// @param segment with all functions of the cell in its pore pressure, in their order
/// @param conductance 12 h times the permeability that the fracture adds, w^3, and its slope by w
/// [m^3, m^2]
/// @param time_over_viscosity [1/Pa]
template <int dim>
void add_flow(const Cell<dim> &cell,
              const Segment<dim> &segment,
              const ValueAndSlope &conductance,
              double time_over_viscosity,
              const State &state,
              Sink &sink);

/// The segment as the network is to see it.
template <int dim>
void leave_to_pores(Segment<dim> &segment)
{
  segment.neighbours.clear();
  segment.has_pressure_of_pores = true;
}
} // namespace permeability_tensor
} // namespace stockwork
