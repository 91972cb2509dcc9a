#include "fracture/damage/damage.h"

namespace stockwork::damage
{
using dealii::Point;
using dealii::Tensor;

template <int dim>
FractureSummary Damage<dim>::summary(const State &state, const Collectives &) const
{
  FractureSummary result;
  for (unsigned int i = 0; i < band.cells.size(); ++i)
  {
    const CrackCell<dim> &crack = band.cells[i];
    const SeamLaw &of_rock = law(crack);
    const double share = crack.area() / CrackCell<dim>::n_points;
    const auto jumps = band.jumps(i, state.current.extra);
    for (unsigned int q = 0; q < jumps.size(); ++q)
    {
      // What has a crack but still holds is intact rock.
      if (crack.greatest[q] > of_rock.start)
        result.length += share * crack.reached;
      if (crack.greatest[q] >= of_rock.critical)
        result.broken_length += share;
      result.stored_energy +=
        0.5 * share * (seam(crack, q, jumps[q]).traction * seam_jump(crack, jumps[q]));
    }
    result.n_tips += dim == 2 && band.is_front(i);
  }
  for (const SlipSpring &spring : springs)
    result.stored_energy += energy_of(spring, state.current.extra);
  result.dissipated_energy = dissipated;
  return result;
}


template <int dim>
void Damage<dim>::write_fields(const State &state, FieldSink<dim> &sink) const
{
  std::vector<double> damage(mesh_view->triangulation.n_active_cells(), 0.), opening(damage),
    pressure(damage);
  for (const auto &owned : band.owned())
  {
    const CrackCell<dim> &crack = band.cells[owned.number];
    const unsigned int index = owned.cell->active_cell_index();
    const Tensor<1, dim> jump = band.jump(owned.number, state.current.extra);
    damage[index] = this->damage(crack);
    opening[index] = jump * crack.normal;
    if (state.segment_pressure)
      pressure[index] = state.segment_pressure(crack.key());
    if constexpr (dim == 2)
    {
      const Tensor<1, dim> along = crack.axes()[0];
      const Point<dim> centre = crack.middle();
      std::vector<std::pair<std::string, double>> values{
        {"aperture", opening[index]}, {"slip", jump * along}, {"damage", damage[index]}};
      const ContactResponse<dim> touching = contact(crack, jump);
      values.emplace_back("contact_pressure", -touching.normal);
      values.emplace_back("friction", touching.shear * along);
      if (state.segment_pressure)
        values.emplace_back("fluid_pressure", pressure[index]);
      sink.add_fracture_piece(
        {centre - 0.5 * crack.area() * along, centre + 0.5 * crack.area() * along}, values);
    }
  }
  sink.add_cell_field("damage", damage);
  sink.add_cell_field("opening", opening);
  if (dim == 3 && state.segment_pressure)
    sink.add_cell_field("fluid_pressure", pressure);
}


template FractureSummary Damage<2>::summary(const State &, const Collectives &) const;
template FractureSummary Damage<3>::summary(const State &, const Collectives &) const;
template void Damage<2>::write_fields(const State &, FieldSink<2> &) const;
template void Damage<3>::write_fields(const State &, FieldSink<3> &) const;
} // namespace stockwork::damage
