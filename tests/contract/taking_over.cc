// A plug-in for tests that does what a peridynamic model would: it takes the momentum rows of all
// vertices in the upper half of the domain, and couples unknowns further apart than a cell. The
// stiffness it puts into these rows is the one the elements had there, and the distant springs
// cancel, so the run must equal the one without it.
#include "stockwork/fracture/registry.h"

#include <deal.II/base/patterns.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <optional>

namespace
{
using namespace dealii;
using namespace stockwork;

class TakingOver : public FractureModel<2>, private KeptTerms
{
public:
  explicit TakingOver(const Scene<2> &scene)
    : scene(scene)
  {
  }

  void setup(const MeshView<2> &mesh, const Collectives &) override
  {
    mesh_view.emplace(mesh);
    taken.assign(mesh.triangulation.n_active_cells(), std::vector<bool>(4, false));
    for (const auto &cell : mesh.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          taken[cell->active_cell_index()][v] = cell->vertex(v)[1] > 0.1;
  }

  CellRole<2> role(const CellIterator &cell) const override
  {
    return {nullptr, &taken[cell->active_cell_index()]};
  }

  const KeptTerms *kept_terms() const override
  {
    return this;
  }

  void assemble(const StepContext &, const State &state, Sink &sink) const override
  {
    const auto &fe = mesh_view->dof_handler.get_fe();
    FEValues<2> values(mesh_view->mapping, fe, QGauss<2>(2), update_gradients | update_JxW_values);
    const FEValuesExtractors::Vector displacement(0);
    LocalSystem local;
    local.bulk.resize(fe.n_dofs_per_cell());
    for (const auto &cell : mesh_view->dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        const RockProperties &rock = scene.rock(cell->material_id());
        values.reinit(cell);
        cell->get_dof_indices(local.bulk);
        local.reinit();
        for (unsigned int i = 0; i < local.bulk.size(); ++i)
        {
          const auto [component, node] = fe.system_to_component_index(i);
          if (component == 2 || !taken[cell->active_cell_index()][node])
            continue;
          for (unsigned int j = 0; j < local.bulk.size(); ++j)
          {
            for (const unsigned int q : values.quadrature_point_indices())
            {
              const auto a = values[displacement].symmetric_gradient(i, q),
                         b = values[displacement].symmetric_gradient(j, q);
              local.matrix(i, j) +=
                (rock.lame_lambda() * trace(a) * trace(b) + 2. * rock.shear_modulus() * (a * b)) *
                values.JxW(q);
            }
            local.residual(i) += local.matrix(i, j) * state.current.bulk(local.bulk[j]);
          }
        }
        sink.add(local);
      }

    for_each_distant_pair(
      [&](const std::vector<types::global_dof_index> &dofs)
      {
        for (const double stiffness : {1e9, -1e9})
        {
          local.bulk = dofs;
          local.reinit();
          for (unsigned int i = 0; i < 2; ++i)
            for (unsigned int j = 0; j < 2; ++j)
              local.matrix(i, j) = i == j ? stiffness : -stiffness;
          sink.add(local);
        }
      });
  }

private:
  unsigned int version() const override
  {
    return 0;
  }

  void add_couplings(const Coupling &couple) const override
  {
    for_each_distant_pair(couple);
  }

  void assemble(const StepContext &, const IndexSet &, Sink &) const override
  {
  }

  /// Vertical displacements of opposite sides of a cell and of its owned neighbour to the right.
  template <class Function>
  void for_each_distant_pair(const Function &use) const
  {
    for (const auto &cell : mesh_view->dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && !cell->face(1)->at_boundary() &&
          cell->neighbor(1)->is_active() && cell->neighbor(1)->is_locally_owned())
      {
        const CellIterator other = cell->neighbor(1);
        use({cell->vertex_dof_index(0, 1), other->vertex_dof_index(3, 1)});
      }
  }

  const Scene<2> &scene;
  std::optional<MeshView<2>> mesh_view;
  std::vector<std::vector<bool>> taken; ///< per active cell, per vertex
};
} // namespace


extern "C" void stockwork_register(FractureModelRegistry &registry)
{
  FractureModelEntry entry;
  entry.description = "For tests: takes rows over and gives back what was in them.";
  entry.declare_parameters = [](ParameterHandler &) {};
  entry.create_2d = [](ParameterHandler &, const Scene<2> &scene)
  { return std::make_unique<TakingOver>(scene); };
  registry.add("taking_over", entry);
}
