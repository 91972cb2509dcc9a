#include "fracture/peridynamics/faces.h"

#include "base/kink.h"
#include "fracture/peridynamics/few_columns.h"

#include <algorithm>
#include <cmath>

namespace stockwork::peridynamics
{
namespace
{
/// Of the stiffness of a cell of rock, over that of faces that touch.
constexpr double softness = 1e-3;
} // namespace


/// Their share in the system of equations while it is being assembled, but for what ends of bonds
/// and bonds that soften have in it.
struct Faces::Rows
{
  LocalSystem local;
  unsigned int n_pores;

  unsigned int pore(const unsigned int i) const
  {
    return i;
  }
  unsigned int jump(const unsigned int mode) const
  {
    return n_pores + 2 * mode;
  }
  unsigned int traction(const unsigned int mode) const
  {
    return jump(mode) + 1;
  }
};


void Faces::assemble_ends(const State &state, Sink &sink) const
{
  LocalSystem local;
  for (unsigned int first = 0; first < ends.size(); first += most_columns)
  {
    const unsigned int n = std::min<unsigned int>(most_columns, ends.size() - first);
    local.bulk.assign(ends.begin() + first, ends.begin() + first + n);
    local.extra.clear();
    for (const Mode &mode : modes)
      local.extra.push_back(mode.traction);
    local.reinit();
    for (unsigned int i = 0; i < n; ++i)
    {
      local.residual(i) = -in_situ[first + i];
      for (unsigned int m = 0; m < modes.size(); ++m)
      {
        const double by_traction = -unit * modes[m].of_ends[first + i];
        local.residual(i) += by_traction * state.current.extra[modes[m].traction];
        local.matrix(i, n + m) = local.matrix(n + m, i) = by_traction;
      }
    }
    sink.add(local);
  }
}


void Faces::assemble_bonds(Sink &sink) const
{
  LocalSystem local;
  for (unsigned int first = 0; first < bonds.size(); first += most_columns)
  {
    const unsigned int n = std::min<unsigned int>(most_columns, bonds.size() - first);
    local.extra.assign(bonds.begin() + first, bonds.begin() + first + n);
    for (const Mode &mode : modes)
      local.extra.push_back(mode.traction);
    local.reinit();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int m = 0; m < modes.size(); ++m)
        local.matrix(n + m, i) = -unit * modes[m].of_bonds[first + i];
    sink.add(local);
  }
}


void Faces::assemble(const State &state, Sink &sink) const
{
  const auto &now = state.current;
  Rows rows;
  rows.n_pores = pores != nullptr ? pores->bulk.size() : 0;
  LocalSystem &local = rows.local;
  if (pores != nullptr)
    local.bulk = pores->bulk;
  for (const Mode &mode : modes)
    local.extra.insert(local.extra.end(), {mode.jump, mode.traction});
  const auto pressure = state.segment_unknown ? state.segment_unknown(segment) : std::nullopt;
  if (pressure)
    local.extra.push_back(*pressure);
  local.reinit();

  for (unsigned int m = 0; m < modes.size(); ++m)
  {
    const Mode &mode = modes[m];
    const unsigned int w = rows.jump(m), y = rows.traction(m);
    const double lost = unit * now.extra[mode.traction];
    local.residual(w) = area * lost;
    local.matrix(w, y) = local.matrix(y, w) = area * unit;
    double volume = mode.constant;
    for (unsigned int i = 0; i < ends.size(); ++i)
      volume += mode.of_ends[i] * now.bulk(ends[i]);
    for (unsigned int i = 0; i < bonds.size(); ++i)
      volume += mode.of_bonds[i] * now.extra[bonds[i]];
    for (unsigned int k = 0; k < modes.size(); ++k)
    {
      volume += mode.of_tractions[k] * unit * now.extra[modes[k].traction];
      local.matrix(y, rows.traction(k)) = -mode.of_tractions[k] * unit * unit;
    }
    local.residual(y) = unit * (area * now.extra[mode.jump] - volume);
  }

  const unsigned int w = rows.jump(0);
  for (unsigned int i = 0; i < rows.n_pores; ++i)
  {
    const unsigned int p = rows.pore(i);
    const double taken = biot_coefficient * area * pores->bulk_coefficients[i];
    local.residual(w) += taken * now.bulk(pores->bulk[i]);
    local.residual(p) =
      taken * (now.extra[modes[0].jump] - state.rate_reference.extra[modes[0].jump]);
    local.matrix(w, p) = local.matrix(p, w) = taken;
  }
  if (modes[0].of_tractions[0] > 0.)
    add_contact(state, rows);
  sink.add(local);
  assemble_ends(state, sink);
  assemble_bonds(sink);
}


void Faces::add_contact(const State &state, Rows &rows) const
{
  const auto &now = state.current;
  LocalSystem &local = rows.local;
  const unsigned int w = rows.jump(0);
  const double c = unit, fluid = state.segment_pressure ? state.segment_pressure(segment) : 0.;
  // The traction by the balance of forces, and that of the law.
  const double balanced = fluid - local.residual(w) / area;
  const double kept = 1. - softness,
               normal = kept * balanced + softness * in_situ_contact + c * now.extra[modes[0].jump];
  if (normal >= -kink_width * (std::abs(fluid) + std::abs(balanced - fluid)))
    return;
  // By each unknown.
  std::vector<std::pair<unsigned int, double>> slope{{w, c}, {rows.traction(0), -kept * unit}};
  for (unsigned int i = 0; i < rows.n_pores; ++i)
    slope.emplace_back(rows.pore(i), -kept * biot_coefficient * pores->bulk_coefficients[i]);
  if (state.segment_unknown && state.segment_unknown(segment))
    slope.emplace_back(local.residual.size() - 1, kept);
  local.residual(w) += area * normal;
  for (const auto &[column, value] : slope)
    local.matrix(w, column) += area * value;
  if (modes.size() == 1 || !rub)
    return;

  const unsigned int s = rows.jump(1);
  const double trial = -unit * now.extra[modes[1].traction] +
                       c * (now.extra[modes[1].jump] - state.committed.extra[modes[1].jump]);
  if (std::abs(trial) < -(1. - kink_width) * friction * normal)
  {
    local.residual(s) += area * trial;
    local.matrix(s, s) += area * c;
    local.matrix(s, rows.traction(1)) -= area * unit;
    return;
  }
  const double signed_friction = trial > 0. ? -friction : friction;
  local.residual(s) += area * signed_friction * normal;
  for (const auto &[column, value] : slope)
    local.matrix(s, column) += area * signed_friction * value;
}
} // namespace stockwork::peridynamics
