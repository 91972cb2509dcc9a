#include "fracture/peridynamics/faces.h"

namespace stockwork::peridynamics
{
void Faces::assemble(const State &state, Sink &sink) const
{
  const auto &now = state.current;
  const unsigned int n_ends = ends.size(), n_pores = pores != nullptr ? pores->bulk.size() : 0;
  LocalSystem local;
  local.bulk = ends;
  if (pores != nullptr)
    local.bulk.insert(local.bulk.end(), pores->bulk.begin(), pores->bulk.end());
  local.extra = {aperture, push};
  local.extra.insert(local.extra.end(), bonds.begin(), bonds.end());
  local.reinit();
  const unsigned int row_w = local.bulk.size(), row_y = row_w + 1;
  const double h = spacing, unit = area / (gamma * h), w = now.extra[aperture],
               stretch = now.extra[push] / h;

  local.residual(row_w) = unit * now.extra[push];
  local.matrix(row_w, row_y) = local.matrix(row_y, row_w) = unit;
  double volume = constant + by_stretch * stretch; // over gamma
  for (unsigned int i = 0; i < n_ends; ++i)
  {
    volume += of_ends[i] * now.bulk(ends[i]);
    local.residual(i) = -of_ends[i] * stretch - in_situ[i];
    local.matrix(i, row_y) = local.matrix(row_y, i) = -of_ends[i] / h;
  }
  for (unsigned int i = 0; i < bonds.size(); ++i)
  {
    volume += of_bonds[i] * now.extra[bonds[i]];
    local.matrix(row_y, row_y + 1 + i) = -of_bonds[i] / h;
  }
  local.residual(row_y) = unit * w - volume / h;
  local.matrix(row_y, row_y) = -by_stretch / (h * h);

  for (unsigned int i = 0; i < n_pores; ++i)
  {
    const unsigned int row = n_ends + i;
    const double taken = biot_coefficient * area * pores->bulk_coefficients[i];
    local.residual(row_w) += taken * now.bulk(pores->bulk[i]);
    local.residual(row) = taken * (w - state.rate_reference.extra[aperture]);
    local.matrix(row_w, row) = local.matrix(row, row_w) = taken;
  }
  sink.add(local);
}
} // namespace stockwork::peridynamics
