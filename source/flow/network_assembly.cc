// What one segment adds to the system of equations.
#include "flow/network.h"

#include "flow/conductivity.h"

#include <algorithm>
#include <cmath>

namespace stockwork
{
/// A segment's share in the system of equations while it is being assembled.
template <int dim>
struct Network<dim>::SegmentRows
{
  const unsigned int index;
  const Segment<dim> &segment;
  const StepContext &context;
  const Values &values;
  LocalSystem &local;

  // Places in the local system: bulk of the opening and of the pore pressure, extra of the opening,
  // own row, that of the pressure drop, the neighbours'; no_row: it has none.
  unsigned int own, cake, p_bulk;
  std::vector<unsigned int> others;

  SegmentRows(const Network &network,
              const unsigned int index,
              const Segment<dim> &segment,
              const StepContext &context,
              const Values &values,
              LocalSystem &local)
    : index(index)
    , segment(segment)
    , context(context)
    , values(values)
    , local(local)
    , p_bulk(segment.opening.bulk.size())
  {
    local.bulk = segment.opening.bulk;
    const unsigned int cake_row = network.leak_off_rows[index];
    if (cake_row != no_row)
      local.bulk.insert(local.bulk.end(), segment.pore_pressure.bulk.begin(),
                        segment.pore_pressure.bulk.end());
    local.extra = segment.opening.extra;
    const auto place_of = [&](const unsigned int row) -> unsigned int
    {
      if (row == no_row)
        return no_row;
      local.extra.push_back(row);
      return local.bulk.size() + local.extra.size() - 1;
    };
    own = place_of(network.rows[index]);
    cake = place_of(cake_row);
    for (const Edge &edge : network.edges[index])
      others.push_back(place_of(network.rows[edge.other]));
    local.reinit();
  }

  bool cavitates() const
  {
    return values.cavitates[index];
  }

  /// For each entry of the opening, its place and coefficient.
  template <class Action>
  void for_opening(const Action &action) const
  {
    const LinearFunctional &B = segment.opening;
    for (unsigned int i = 0; i < B.bulk.size(); ++i)
      action(i, B.bulk_coefficients[i]);
    for (unsigned int i = 0; i < B.extra.size(); ++i)
      action(local.bulk.size() + i, B.extra_coefficients[i]);
  }

  void add_aperture_slope(const unsigned int row, const double slope)
  {
    for_opening([&](const unsigned int column, const double b)
                { local.matrix(row, column) += slope * b; });
    if (own != no_row)
      local.matrix(row, own) += slope * segment.opening_by_pressure;
  }

  /// On the rock: external work A p dw.
  void add_load()
  {
    for_opening(
      [&](const unsigned int row, const double b)
      {
        local.residual(row) -= segment.area * values.pressure[index] * b;
        if (own != no_row)
          local.matrix(row, own) -= segment.area * b;
      });
  }
};


/// The segment's load on the rock and its row of the fluid balance, and what its aperture does to
/// the rows of its neighbours.
template <int dim>
void Network<dim>::assemble_segment(const unsigned int index,
                                    const Segment<dim> &segment,
                                    const StepContext &context,
                                    const Values &values,
                                    LocalSystem &local) const
{
  SegmentRows rows_of(*this, index, segment, context, values, local);
  rows_of.add_load();
  add_storage(rows_of);
  add_flow(rows_of);
  if (leak_off == LeakOff::carter)
    add_carter_leak_off(rows_of);
  add_leak_off_by_pressure(rows_of);
}


/// Of a segment that another rank owns: what the unknowns of this part of the opening do to the
/// fluid, and the fluid to them.
template <int dim>
void Network<dim>::keep_part_of_opening(const Segment<dim> &segment, LocalSystem &local)
{
  const unsigned int n = local.residual.size(), n_bulk = segment.opening.bulk.size();
  const auto is_of_opening = [&](const unsigned int i)
  {
    return i < n_bulk ||
           (i >= local.bulk.size() && i < local.bulk.size() + segment.opening.extra.size());
  };
  for (unsigned int i = 0; i < n; ++i)
    if (!is_of_opening(i))
    {
      local.residual(i) = 0.;
      for (unsigned int j = 0; j < n; ++j)
        if (!is_of_opening(j))
          local.matrix(i, j) = 0.;
    }
}


/// In a segment that cavitates, the whole row.
template <int dim>
void Network<dim>::add_storage(SegmentRows &rows_of) const
{
  const unsigned int own = rows_of.own, index = rows_of.index;
  if (own == no_row)
    return;
  LocalSystem &local = rows_of.local;
  const Values &values = rows_of.values;
  const double w = values.aperture[index], p = values.pressure[index];
  if (rows_of.cavitates())
  {
    local.residual(own) -= vapour_scale(index) * (p - vapour_pressure);
    local.matrix(own, own) -= vapour_scale(index);
    return;
  }
  // Pressures have a rate of their own; balances are integrated over 1/rate.
  const double c_f = compressibility * rows_of.context.fracture_pressure_factor();
  const double area = rows_of.segment.area, open = std::max(w, 0.),
               dp = p - values.pressure_reference[index];
  local.residual(own) -= area * (w - values.aperture_reference[index] + open * c_f * dp);
  const double stored = rows_of.context.damaged_pores ? rows_of.segment.damaged_storage : 0.;
  local.residual(own) -= area * stored * dp;
  local.matrix(own, own) -= area * (open * c_f + stored);
  rows_of.add_aperture_slope(own, -area * (1. + (w > 0. ? c_f * dp : 0.)));
}


/// To the neighbours.
template <int dim>
void Network<dim>::add_flow(SegmentRows &rows_of) const
{
  const unsigned int own = rows_of.own, index = rows_of.index;
  LocalSystem &local = rows_of.local;
  const Values &values = rows_of.values;
  const double p = values.pressure[index], dt = rows_of.context.fracture_dt();
  for (unsigned int e = 0; e < edges[index].size(); ++e)
  {
    const Edge &edge = edges[index][e];
    const Transmissibility T = transmissibility(index, edge, values);
    const double difference = p - values.pressure[edge.other];
    const unsigned int other = rows_of.others[e];
    if (own != no_row && !rows_of.cavitates())
    {
      local.residual(own) -= dt * T.value * difference;
      local.matrix(own, own) -= dt * T.value;
      if (other != no_row)
        local.matrix(own, other) += dt * T.value;
      rows_of.add_aperture_slope(own, -dt * T.slope_i * difference);
    }
    if (other != no_row && !values.cavitates[edge.other])
      rows_of.add_aperture_slope(other, dt * T.slope_i * difference);
  }
}


template <int dim>
void Network<dim>::add_carter_leak_off(SegmentRows &rows_of) const
{
  if (rows_of.own == no_row)
    return;
  const StepContext &context = rows_of.context;
  const Exposure times = exposure(rows_of.index, context, rows_of.values);
  const double faces = 2. * rows_of.segment.area * context.fracture_dt() / context.dt;
  rows_of.local.residual(rows_of.own) -=
    faces * carter_volume(carter_coefficient, times.begin, times.end);
  if (times.end > 0.)
    rows_of.add_aperture_slope(rows_of.own,
                               -faces * carter_coefficient / std::sqrt(times.end) * times.slope);
}


/// c d enters the balances of fracture and rock, and c (d - p + p_m) = 0. Where the pores carry the
/// fluid of the fracture, c (p_m - p) = 0, and d is the multiplier that holds them equal.
template <int dim>
void Network<dim>::add_leak_off_by_pressure(SegmentRows &rows_of) const
{
  const unsigned int own = rows_of.own, cake = rows_of.cake, index = rows_of.index;
  LocalSystem &local = rows_of.local;
  const LinearFunctional &P = rows_of.segment.pore_pressure;
  const double dt = rows_of.context.fracture_dt();
  const double c = 2. * rows_of.segment.area * dt * leak_off_coefficient(index),
               d = rows_of.values.filter_cake_drop[index], p = rows_of.values.pressure[index];
  if (c > 0. && own != no_row && !rows_of.cavitates())
  {
    local.residual(own) -= c * d;
    if (cake == no_row)
      local.matrix(own, own) -= c;
  }
  if (cake == no_row)
    return;
  const double drop = network[index].has_pressure_of_pores ? 0. : 1.;
  local.residual(cake) += c * (drop * d - p + rows_of.values.pore_pressure[index]);
  local.matrix(cake, cake) += c * drop;
  if (own != no_row)
  {
    local.matrix(cake, own) -= c;
    if (!rows_of.cavitates())
      local.matrix(own, cake) -= c;
  }
  // The balance of the rock is over the time of its scheme.
  const double c_rock = c * rows_of.context.effective_dt() / dt;
  for (unsigned int i = 0; i < P.bulk.size(); ++i)
  {
    const unsigned int row = rows_of.p_bulk + i;
    local.residual(row) += c_rock * d * P.bulk_coefficients[i];
    local.matrix(cake, row) += c * P.bulk_coefficients[i];
    local.matrix(row, cake) += c_rock * P.bulk_coefficients[i];
  }
}


template void Network<2>::assemble_segment(
  unsigned int, const Segment<2> &, const StepContext &, const Values &, LocalSystem &) const;
template void Network<3>::assemble_segment(
  unsigned int, const Segment<3> &, const StepContext &, const Values &, LocalSystem &) const;
} // namespace stockwork
