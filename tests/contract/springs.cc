// A plug-in for tests that uses what the other models leave out: a law of its own in some cells
// that sees the pressure of the fracture's fluid there, with a history, and segments whose opening
// hangs on that pressure as well. The physics is made up, but conserves energy and fluid.
#include "stockwork/fracture/registry.h"
#include "stockwork/mesh/key.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <map>

namespace
{
using namespace dealii;
using namespace stockwork;

/// The rock inside, and a pressure's push that grows with its square and once it has been there
/// stays in part.
class PushedRock : public RockLaw
{
public:
  explicit PushedRock(const RockLaw &inside)
    : inside(inside)
  {
  }

  std::vector<HistoryField> history() const override
  {
    return {{"maximum_pressure"}};
  }

  void evaluate(ArrayView<const RockState> states, ArrayView<RockResponse> responses) const override
  {
    inside.evaluate(states, responses);
    const auto identity = unit_symmetric_tensor<3>();
    for (unsigned int q = 0; q < states.size(); ++q)
    {
      RockResponse &response = responses[q];
      const double p = states[q].fracture_pressure,
                   greatest = states[q].history != nullptr ? states[q].history[0] : 0.;
      constexpr double scale = 1e7;
      response.stress -= (0.1 * p * p / scale + 0.05 * greatest) * identity;
      response.stress_by_fracture_pressure = -0.2 * p / scale * identity;
      response.content += 1e-12 * p;
      response.content_by_fracture_pressure = 1e-12;
      if (response.history != nullptr)
        response.history[0] = std::max(p, greatest);
    }
  }

  double used(const RockState &) const override
  {
    return 0.;
  }

  double margin(const RockState &) const override
  {
    return 0.;
  }

private:
  const RockLaw &inside;
};


template <int dim>
class Springs : public FractureModel<dim>
{
public:
  using typename FractureModel<dim>::CellIterator;

  explicit Springs(const Scene<dim> &scene)
    : scene(scene)
    , law(scene.rock_law(0))
  {
  }

  Requirements requirements() const override
  {
    Requirements requirements;
    requirements.symmetric = false;
    requirements.law = &law;
    return requirements;
  }

  void setup(const MeshView<dim> &mesh, const Collectives &) override
  {
    owned.clear();
    keys.clear();
    std::map<CellId, unsigned int> number;
    for (const auto &cell : mesh.dof_handler.active_cell_iterators())
      if (!cell->is_artificial() && is_cracked(cell->center()))
        keys[cell->active_cell_index()] = Key().add(cell->id());
    const auto &fe = mesh.dof_handler.get_fe();
    FEValues<dim> values(mesh.mapping, fe, QMidpoint<dim>(), update_gradients | update_values);
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : mesh.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && is_cracked(cell->center()))
      {
        Segment<dim> segment;
        const double h = cell->extent_in_direction(1);
        segment.key = keys.at(cell->active_cell_index());
        segment.centre = cell->center();
        segment.normal[1] = 1.;
        segment.area = cell->measure() / h;
        values.reinit(cell);
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (fe.system_to_component_index(i).first == 1)
          {
            segment.opening.bulk.push_back(dofs[i]);
            segment.opening.bulk_coefficients.push_back(h * values.shape_grad(i, 0)[1]);
          }
          else if (fe.system_to_component_index(i).first == dim)
          {
            segment.pore_pressure.bulk.push_back(dofs[i]);
            segment.pore_pressure.bulk_coefficients.push_back(values.shape_value(i, 0));
          }
        segment.opening_by_pressure = 1e-11; // of the size of h / E
        segment.share_of_pores = 1.;
        for (const unsigned int f : {0, 1})
          if (!cell->at_boundary(f) && is_cracked(cell->neighbor(f)->center()))
            segment.neighbours.push_back({keys.at(cell->neighbor(f)->active_cell_index()),
                                          0.5 * cell->extent_in_direction(0),
                                          segment.area / cell->extent_in_direction(0)});
        owned.push_back(segment);
      }
  }

  ArrayView<const Segment<dim>> segments() const override
  {
    return make_array_view(owned);
  }

  CellRole<dim> role(const CellIterator &cell) const override
  {
    CellRole<dim> role;
    if (const auto key = keys.find(cell->active_cell_index()); key != keys.end())
    {
      role.law = &law;
      role.segment = key->second;
    }
    return role;
  }

private:
  static bool is_cracked(const Point<dim> &centre)
  {
    return centre[0] < 4. && std::abs(centre[1] - 0.5) < 0.5;
  }

  const Scene<dim> &scene;
  const PushedRock law;
  std::vector<Segment<dim>> owned;
  std::map<unsigned int, std::uint64_t> keys; ///< by active cell index
};
} // namespace


extern "C" void stockwork_register(FractureModelRegistry &registry)
{
  FractureModelEntry entry;
  entry.description = "For tests: a law that sees the fracture's fluid.";
  entry.create_2d = [](ParameterHandler &, const Scene<2> &scene)
  { return std::make_unique<Springs<2>>(scene); };
  entry.create_3d = [](ParameterHandler &, const Scene<3> &scene)
  { return std::make_unique<Springs<3>>(scene); };
  registry.add("springs", entry);
}
