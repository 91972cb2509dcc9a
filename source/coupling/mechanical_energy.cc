#include "coupling/mechanical_energy.h"

#include "stockwork/rock/linear_stiffness.h"

#include "biot/prescribed_part.h"
#include "exchange/cell_evaluator.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace stockwork
{
using namespace dealii;

namespace
{
/// 1/2 rho v^2 of the cell, and its share in the work of tractions.
template <int dim>
struct MovingCell
{
  MovingCell(const MeshView<dim> &mesh_view, const Loads<dim> &loads)
    : loads(loads)
    , at_points(mesh_view.mapping,
                mesh_view.dof_handler.get_fe(),
                QGauss<dim>(mesh_view.dof_handler.get_fe().degree + 1),
                update_values | update_JxW_values)
    , at_vertices(mesh_view.mapping,
                  mesh_view.dof_handler.get_fe(),
                  QTrapezoid<dim>(),
                  update_values | update_JxW_values)
    , face_values(mesh_view.mapping,
                  mesh_view.dof_handler.get_fe(),
                  QGauss<dim - 1>(mesh_view.dof_handler.get_fe().degree + 1),
                  update_values | update_quadrature_points | update_normal_vectors |
                    update_JxW_values)
  {
  }

  /// @param lumps_mass the mass is that of points at the vertices, which are all of the nodes
  double kinetic_energy(const typename DoFHandler<dim>::active_cell_iterator &cell,
                        const bool lumps_mass,
                        const double density,
                        const StepContext &context,
                        const State &state)
  {
    FEValues<dim> &values = lumps_mass ? at_vertices : at_points;
    values.reinit(cell);
    now.resize(values.n_quadrature_points);
    before.resize(now.size());
    values[displacement].get_function_values(state.current.bulk, now);
    values[displacement].get_function_values(state.rate_reference.bulk, before);
    double energy = 0.;
    for (unsigned int q = 0; q < now.size(); ++q)
      energy += 0.5 * density * (context.rate * (now[q] - before[q])).norm_square() * values.JxW(q);
    return energy;
  }

  double work(const typename DoFHandler<dim>::active_cell_iterator &cell,
              const StepContext &context,
              const State &state)
  {
    double work = 0.;
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary())
      {
        const auto id = cell->face(f)->boundary_id();
        const auto traction = loads.traction.find(id);
        const auto normal = loads.normal_traction.find(id);
        if (traction == loads.traction.end() && normal == loads.normal_traction.end())
          continue;
        face_values.reinit(cell, f);
        now.resize(face_values.n_quadrature_points);
        before.resize(now.size());
        face_values[displacement].get_function_values(state.current.bulk, now);
        face_values[displacement].get_function_values(state.committed.bulk, before);
        for (unsigned int q = 0; q < now.size(); ++q)
        {
          const Point<dim> &x = face_values.quadrature_point(q);
          for (const double time : {context.time - context.dt, context.time})
          {
            Tensor<1, dim> t;
            if (traction != loads.traction.end())
              for (unsigned int d = 0; d < dim; ++d)
                t[d] += traction->second[d].value(x, time);
            if (normal != loads.normal_traction.end())
              t += normal->second.value(x, time) * face_values.normal_vector(q);
            work += 0.5 * t * (now[q] - before[q]) * face_values.JxW(q);
          }
        }
      }
    return work;
  }

  const FEValuesExtractors::Vector displacement{0};
  const Loads<dim> &loads;
  FEValues<dim> at_points, at_vertices;
  FEFaceValues<dim> face_values;
  std::vector<Tensor<1, dim>> now, before;
};


/// What the rock exerts on held unknowns whose rows are a fracture model's own: bonds, not
/// elements, hold a side that the deck moves there.
template <int dim>
class ModelForces
{
public:
  explicit ModelForces(const FractureModel<dim> &model)
    : model(model)
  {
  }

  /// One that this rank owns.
  void hold(const types::global_dof_index dof)
  {
    forces.emplace(dof, 0.);
  }

  bool any(const Collectives &collectives) const
  {
    return collectives.max(static_cast<double>(forces.size())) > 0.;
  }

  /// By unknown [N; N/m in 2-D].
  const std::map<types::global_dof_index, double> &
  at(const StepContext &context, const State &state, const IndexSet &owned)
  {
    IndexSet rows(owned.size());
    for (auto &[dof, force] : forces)
    {
      rows.add_index(dof);
      force = 0.;
    }
    Rows linear(forces, &state.current.bulk), others(forces, nullptr);
    if (const KeptTerms *const kept = model.kept_terms())
      kept->assemble(context, rows, linear);
    model.assemble(context, state, others);
    return forces;
  }

private:
  struct Rows : public Sink
  {
    Rows(std::map<types::global_dof_index, double> &forces,
         const TrilinosWrappers::MPI::BlockVector *const values)
      : forces(forces)
      , values(values)
    {
    }

    void add(const LocalSystem &local) override
    {
      for (unsigned int i = 0; i < local.bulk.size(); ++i)
        if (const auto row = forces.find(local.bulk[i]); row != forces.end())
        {
          if (values == nullptr)
            row->second += local.residual(i);
          for (unsigned int j = 0; j < local.bulk.size() && values != nullptr; ++j)
            if (local.matrix(i, j) != 0.)
              row->second += local.matrix(i, j) * (*values)(local.bulk[j]);
        }
    }

    std::map<types::global_dof_index, double> &forces;
    const TrilinosWrappers::MPI::BlockVector *values; ///< that the matrix acts on; null: a residual
  };

  const FractureModel<dim> &model;
  std::map<types::global_dof_index, double> forces;
};
} // namespace


template <int dim>
MechanicalEnergy mechanical_energy(const MeshView<dim> &mesh_view,
                                   const Rock &rock,
                                   const NonlinearRock<dim> *nonlinear,
                                   const Loads<dim> &loads,
                                   const FractureModel<dim> &model,
                                   const StepContext &context,
                                   const State &state,
                                   const Collectives &collectives)
{
  const auto &fe = mesh_view.dof_handler.get_fe();
  const auto &constraints = mesh_view.constraints;
  CellEvaluator<dim> evaluator(mesh_view.mapping, fe, QGauss<dim>(fe.degree + 1));
  std::vector<SymmetricTensor<2, dim>> now, before;
  std::vector<unsigned int> held; // functions whose displacement is prescribed or hangs

  MovingCell<dim> moving(mesh_view, loads);
  ModelForces<dim> of_model(model);
  double stored = 0., kinetic = 0., work = 0., force = 0., greatest = 0.;
  const auto add_work = [&](const unsigned int q, const SymmetricTensor<2, dim> &mean_stress,
                            const SymmetricTensor<2, dim> &stress)
  {
    for (const unsigned int function : held)
    {
      const auto dof = evaluator.dofs()[evaluator.layout.u[function]];
      const SymmetricTensor<2, dim> strain = evaluator.weight(q) * evaluator.strain_of(function, q);
      const double u = prescribed_part(constraints, dof, state.current.bulk);
      work +=
        (mean_stress * strain) * (u - prescribed_part(constraints, dof, state.committed.bulk));
      force += (stress * strain) * u;
      greatest = std::max(greatest, std::abs(u));
    }
  };

  for (const auto &cell : mesh_view.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const CellRole<dim> cell_role = model.role(cell);
      evaluator.reinit(cell, cell_role.cut);
      held.clear();
      for (unsigned int k = 0; k < evaluator.layout.u.size(); ++k)
        if (const auto dof = evaluator.dofs()[evaluator.layout.u[k]];
            constraints.is_constrained(dof))
        {
          const unsigned int vertex = k / dim;
          if (cell_role.skip_stiffness == nullptr || !(*cell_role.skip_stiffness)[vertex])
            held.push_back(k);
          else if (mesh_view.dof_handler.locally_owned_dofs().is_element(dof) &&
                   (state.current.bulk(dof) != 0. || state.committed.bulk(dof) != 0.))
            of_model.hold(dof); // one at rest takes no part in work or load
        }
      const RockProperties properties = rock.at(cell->material_id(), cell->center());
      const LinearStiffness<dim> hooke(properties);
      double share = 1.; // of the cell, that belongs to nodes of the elements
      if (const std::vector<bool> *skipped = cell_role.skip_stiffness)
        share -= double(std::count(skipped->begin(), skipped->end(), true)) / skipped->size();

      evaluator.strain(state.current, now);
      if (!held.empty())
        evaluator.strain(state.committed, before);
      for (unsigned int q = 0; q < now.size(); ++q)
      {
        const SymmetricTensor<2, dim> stress = hooke.stress(now[q]);
        stored += share * 0.5 * evaluator.weight(q) * (stress * now[q]);
        if (!held.empty())
          add_work(q, 0.5 * (stress + hooke.stress(before[q])), stress);
      }
      if (context.acceleration > 0.)
      {
        kinetic +=
          moving.kinetic_energy(cell, cell_role.lumps_mass, properties.density, context, state);
        work += moving.work(cell, context, state);
      }
    }
  if (nonlinear != nullptr)
  {
    stored += nonlinear->totals().stored_energy_beyond;
    work += nonlinear->totals().held_work_beyond;
    force += nonlinear->totals().held_force_beyond;
  }
  if (of_model.any(collectives))
  {
    const IndexSet &owned = mesh_view.dof_handler.locally_owned_dofs();
    const auto moved = [&](const types::global_dof_index dof)
    { return state.current.bulk(dof) - state.committed.bulk(dof); };
    const State before{state.committed,        state.committed,
                       state.rate_reference,   state.acceleration_reference,
                       state.segment_pressure, state.segment_unknown};
    for (const auto &[dof, of_rock] : of_model.at(context, before, owned))
      work += 0.5 * of_rock * moved(dof);
    for (const auto &[dof, of_rock] : of_model.at(context, state, owned))
    {
      work += 0.5 * of_rock * moved(dof);
      force += of_rock * state.current.bulk(dof);
      greatest = std::max(greatest, std::abs(state.current.bulk(dof)));
    }
  }
  greatest = collectives.max(greatest);
  std::vector<double> sums{stored, kinetic, work, force};
  collectives.sum(sums);
  return {sums[0], sums[1], sums[2], greatest > 0. ? sums[3] / greatest : 0.};
}


template MechanicalEnergy mechanical_energy(const MeshView<2> &,
                                            const Rock &,
                                            const NonlinearRock<2> *,
                                            const Loads<2> &,
                                            const FractureModel<2> &,
                                            const StepContext &,
                                            const State &,
                                            const Collectives &);
template MechanicalEnergy mechanical_energy(const MeshView<3> &,
                                            const Rock &,
                                            const NonlinearRock<3> *,
                                            const Loads<3> &,
                                            const FractureModel<3> &,
                                            const StepContext &,
                                            const State &,
                                            const Collectives &);
} // namespace stockwork
