#include "biot/nonlinear_rock.h"

#include "stockwork/rock/linear_law.h"

#include "biot/plane_tensors.h"
#include "biot/prescribed_part.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stockwork
{
using namespace dealii;

namespace
{
template <int dim>
QGauss<dim> quadrature_of(const FiniteElement<dim> &fe)
{
  return QGauss<dim>(fe.base_element(0).degree + 1);
}
} // namespace


template <int dim>
NonlinearRock<dim>::NonlinearRock(const RockLaws &laws,
                                  const Scene<dim> &scene,
                                  const Role &role,
                                  const RockLaw *const law_of_model)
  : laws(laws)
  , scene(scene)
  , role(role)
  , law_of_model(law_of_model)
{
}


template <int dim>
void NonlinearRock<dim>::setup(const MeshView<dim> &new_mesh_view)
{
  mesh_view = std::make_unique<const MeshView<dim>>(new_mesh_view);
  const auto &fe = mesh_view->dof_handler.get_fe();
  const auto quadrature = quadrature_of(fe);
  evaluator = std::make_unique<CellEvaluator<dim>>(mesh_view->mapping, fe, quadrature);
  if (!points)
  {
    unsigned int n = 0;
    for (const RockLaw *const law : all_laws())
      n = std::max(n, law->n_history());
    points = std::make_unique<PointHistory<dim>>(n_core + n, quadrature.get_points());
    points->reinit(mesh_view->dof_handler.get_triangulation().n_active_cells());
  }
  find_watched();
}


template <int dim>
void NonlinearRock<dim>::find_watched()
{
  watched.clear();
  for (const auto &cell : mesh_view->dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && answers(cell))
      watched.push_back({cell, 0., 0.});
  has_looked = false;
}


template <int dim>
void NonlinearRock<dim>::topology_changed()
{
  evaluator->forget_cuts();
  if (law_of_model != nullptr)
    find_watched();
}


template <int dim>
std::vector<const RockLaw *> NonlinearRock<dim>::all_laws() const
{
  std::vector<const RockLaw *> all;
  for (const auto &[region, law] : laws.all())
    all.push_back(law.get());
  if (law_of_model != nullptr)
    all.push_back(law_of_model);
  return all;
}


template <int dim>
typename NonlinearRock<dim>::InSituShare NonlinearRock<dim>::in_situ_share()
{
  InSituShare share;
  for (const auto &cell : mesh_view->dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && answers(cell))
    {
      evaluator->reinit(cell, nullptr);
      for (unsigned int q = 0; q < evaluator->n_points(); ++q)
      {
        const Point<dim> &x = evaluator->point(q);
        RockState state;
        state.in_situ_stress = scene.in_situ_tensor(x, scene.rock(cell->material_id()));
        state.in_situ_pressure = scene.in_situ_pore_pressure(x);
        const double used = law(cell).used(state);
        if (used > share.used)
          share = {used, x, cell->material_id()};
      }
    }
  return share;
}


template <int dim>
void NonlinearRock<dim>::states_at(const CellIterator &cell,
                                   const State &state,
                                   const Unknowns &unknowns)
{
  const RockProperties &rock = scene.rock(cell->material_id());
  const auto segment = law_of_model != nullptr ? role(cell).segment : std::nullopt;
  const double fracture_pressure = segment ? state.pressure_of(*segment, unknowns) : 0.;
  evaluator->strain(unknowns, strains);
  evaluator->pressure(unknowns, pressures);
  states.resize(evaluator->n_points());
  for (unsigned int q = 0; q < states.size(); ++q)
  {
    const Point<dim> &x = evaluator->point(q);
    states[q].strain = in_space(strains[q]);
    states[q].pressure = pressures[q];
    states[q].in_situ_stress = scene.in_situ_tensor(x, rock);
    states[q].in_situ_pressure = scene.in_situ_pore_pressure(x);
    states[q].fracture_pressure = fracture_pressure;
    states[q].history = committed[q] != nullptr ? committed[q] + n_core : nullptr;
  }
}


template <int dim>
void NonlinearRock<dim>::find_history(const CellIterator &cell)
{
  const unsigned int index = cell->active_cell_index();
  committed.assign(evaluator->n_points(), nullptr);
  if (!points->has(index))
    return;
  const CutCell<dim> *const cut = role(cell).cut;
  for (unsigned int q = 0; q < committed.size(); ++q)
    committed[q] = points->nearest(index, evaluator->unit_points()[q], cut);
}


namespace
{
/// The greatest change of an unknown of a block, ghosts included.
double maximum_change(const TrilinosWrappers::MPI::Vector &now,
                      const TrilinosWrappers::MPI::Vector &before)
{
  const auto &a = now.trilinos_vector(), &b = before.trilinos_vector();
  double greatest = 0.;
  for (int i = 0; i < a.MyLength(); ++i)
    greatest = std::max(greatest, std::abs(a[0][i] - b[0][i]));
  return greatest;
}
} // namespace


template <int dim>
void NonlinearRock<dim>::look_around(const State &state, const Unknowns &unknowns)
{
  last_totals.maximum_used = 0.;
  for (Watched &item : watched)
  {
    const RockLaw &law = this->law(item.cell);
    evaluator->reinit(item.cell, role(item.cell).cut);
    find_history(item.cell);
    states_at(item.cell, state, unknowns);
    item.margin = std::numeric_limits<double>::infinity();
    double steepest = 0.;
    for (unsigned int q = 0; q < states.size(); ++q)
    {
      item.margin = std::min(item.margin, law.margin(states[q]));
      double sum = 0.;
      for (unsigned int a = 0; a < evaluator->layout.n_u; ++a)
        sum += evaluator->gradient(a * dim, q).norm();
      steepest = std::max(steepest, sum);
      if (committed[q] == nullptr)
        last_totals.maximum_used = std::max(last_totals.maximum_used, law.used(states[q]));
    }
    // |stress| <= max(3 K, 2 G) |strain| with |strain| <= sum_a |grad N_a| |u_a|; in anisotropic
    // rock the norm of the stiffness is no less.
    const RockProperties &rock = scene.rock(item.cell->material_id());
    const double stiffest = rock.stiffness
                              ? rock.stiffness->norm()
                              : 2. * rock.shear_modulus() + std::max(0., 3. * rock.lame_lambda());
    item.slope = stiffest * steepest * std::sqrt(double(dim));
  }
  looked_at = unknowns.bulk;
  has_looked = true;
}


template <int dim>
template <class Use>
void NonlinearRock<dim>::visit(const State &state, const Use &use)
{
  if (!has_looked)
    look_around(state, state.committed);
  const auto &now = state.current.bulk;
  const double moved = maximum_change(now.block(0), looked_at.block(0)),
               pressed = now.n_blocks() > 1 ? maximum_change(now.block(1), looked_at.block(1)) : 0.;
  for (const Watched &item : watched)
  {
    const CellRole<dim> cell_role = role(item.cell);
    const bool has_history = points->has(item.cell->active_cell_index());
    // A law that sees a fracture's pressure may answer anew though the bulk has not moved.
    if (!has_history && cell_role.cut == nullptr && !cell_role.segment &&
        item.slope * moved + std::sqrt(3.) * pressed < item.margin)
      continue;
    evaluator->reinit(item.cell, cell_role.cut);
    find_history(item.cell);
    states_at(item.cell, state, state.current);
    const RockLaw &law = this->law(item.cell);
    if (has_history || std::any_of(states.begin(), states.end(),
                                   [&](const RockState &s) { return law.margin(s) <= 0.; }))
      use(item.cell);
  }
}


template <int dim>
unsigned int NonlinearRock<dim>::place(const unsigned int function) const
{
  const auto &u = evaluator->layout.u;
  return function < u.size() ? u[function] : evaluator->dofs().size() + function - u.size();
}


template <int dim>
SymmetricTensor<2, dim> NonlinearRock<dim>::mobility_beyond(const RockProperties &rock,
                                                            const unsigned int q) const
{
  return (in_plane<dim>(responses[q].permeability) - rock.template permeability_tensor<dim>()) /
         scene.rock.fluid().viscosity;
}


template <int dim>
void NonlinearRock<dim>::add_cell(const CellIterator &cell,
                                  const StepContext &context,
                                  const State &state,
                                  LocalSystem &local)
{
  const RockProperties &rock = scene.rock(cell->material_id());
  const RockLaw &law = this->law(cell);
  local.bulk = evaluator->dofs();
  local.extra = evaluator->extra();
  const auto segment = law_of_model != nullptr ? role(cell).segment : std::nullopt;
  const auto unknown =
    segment && state.segment_unknown ? state.segment_unknown(*segment) : std::nullopt;
  if (unknown)
    local.extra.push_back(*unknown);
  local.reinit();

  responses.assign(states.size(), RockResponse());
  law.evaluate(make_array_view(states.cbegin(), states.cend()),
               make_array_view(responses.begin(), responses.end()));
  const bool flows = law.changes_permeability() && evaluator->layout.n_p > 0;
  if (flows)
    evaluator->pressure_gradient(state.current, pressure_gradients);
  for (unsigned int q = 0; q < states.size(); ++q)
  {
    add_stress_and_content(rock, q, local);
    if (unknown)
      add_fracture_pressure(q, local.matrix.n() - 1, local);
    if (flows)
      add_flow(rock, context, q, local);
  }
}


template <int dim>
void NonlinearRock<dim>::add_stress_and_content(const RockProperties &rock,
                                                const unsigned int q,
                                                LocalSystem &local) const
{
  const auto &layout = evaluator->layout;
  const unsigned int n = evaluator->n_functions();
  const double w = evaluator->weight(q);
  const RockResponse &response = responses[q], linear = linear_response(rock, states[q]);
  const Tensor<2, dim> stress = in_plane<dim>(response.stress - linear.stress);
  for (unsigned int i = 0; i < n; ++i)
    local.residual(place(i)) += stress[evaluator->component(i)] * evaluator->gradient(i, q) * w;
  const double content = response.content - linear.content -
                         (committed[q] != nullptr ? committed[q][content_beyond] : 0.);
  for (unsigned int a = 0; a < layout.n_p; ++a)
    local.residual(layout.p[a]) -= evaluator->pressure_value(a, q) * content * w;

  const auto stiffness = in_plane<dim>(response.stress_by_strain - linear.stress_by_strain);
  const Tensor<2, dim> by_pressure =
    in_plane<dim>(response.stress_by_pressure - linear.stress_by_pressure);
  const Tensor<2, dim> by_strain =
    in_plane<dim>(response.content_by_strain - linear.content_by_strain);
  const double storage = response.content_by_pressure - linear.content_by_pressure;
  for (unsigned int j = 0; j < n; ++j)
  {
    const Tensor<2, dim> change = w * (stiffness * evaluator->strain_of(j, q));
    for (unsigned int i = 0; i < n; ++i)
      local.matrix(place(i), place(j)) +=
        change[evaluator->component(i)] * evaluator->gradient(i, q);
    const double along = w * (by_pressure[evaluator->component(j)] * evaluator->gradient(j, q)),
                 gained = w * (by_strain[evaluator->component(j)] * evaluator->gradient(j, q));
    for (unsigned int a = 0; a < layout.n_p; ++a)
    {
      local.matrix(place(j), layout.p[a]) += along * evaluator->pressure_value(a, q);
      local.matrix(layout.p[a], place(j)) -= gained * evaluator->pressure_value(a, q);
    }
  }
  for (unsigned int a = 0; a < layout.n_p; ++a)
    for (unsigned int b = 0; b < layout.n_p; ++b)
      local.matrix(layout.p[a], layout.p[b]) -=
        w * storage * evaluator->pressure_value(a, q) * evaluator->pressure_value(b, q);
}


template <int dim>
void NonlinearRock<dim>::add_fracture_pressure(const unsigned int q,
                                               const unsigned int column,
                                               LocalSystem &local) const
{
  const double w = evaluator->weight(q);
  const Tensor<2, dim> stress = in_plane<dim>(responses[q].stress_by_fracture_pressure);
  for (unsigned int i = 0; i < evaluator->n_functions(); ++i)
    local.matrix(place(i), column) +=
      w * (stress[evaluator->component(i)] * evaluator->gradient(i, q));
  for (unsigned int a = 0; a < evaluator->layout.n_p; ++a)
    local.matrix(evaluator->layout.p[a], column) -=
      w * evaluator->pressure_value(a, q) * responses[q].content_by_fracture_pressure;
}


template <int dim>
void NonlinearRock<dim>::add_flow(const RockProperties &rock,
                                  const StepContext &context,
                                  const unsigned int q,
                                  LocalSystem &local) const
{
  const auto &p = evaluator->layout.p;
  const double w = context.effective_dt() * evaluator->weight(q),
               per_viscosity = 1. / scene.rock.fluid().viscosity;
  const SymmetricTensor<2, dim> mobility = mobility_beyond(rock, q);
  const Tensor<1, dim> &slope = pressure_gradients[q];
  const auto by_strain = in_plane<dim>(responses[q].permeability_by_strain);
  const Tensor<1, dim> by_pressure =
    per_viscosity * (in_plane<dim>(responses[q].permeability_by_pressure) * slope);
  std::vector<Tensor<1, dim>> by_function(evaluator->n_functions());
  for (unsigned int j = 0; j < by_function.size(); ++j)
    by_function[j] = per_viscosity * ((by_strain * evaluator->strain_of(j, q)) * slope);
  for (unsigned int a = 0; a < p.size(); ++a)
  {
    const Tensor<1, dim> test = w * evaluator->pressure_gradient(a, q);
    local.residual(p[a]) -= test * (mobility * slope);
    for (unsigned int b = 0; b < p.size(); ++b)
      local.matrix(p[a], p[b]) -= test * (mobility * evaluator->pressure_gradient(b, q) +
                                          evaluator->pressure_value(b, q) * by_pressure);
    for (unsigned int j = 0; j < by_function.size(); ++j)
      local.matrix(p[a], place(j)) -= test * by_function[j];
  }
}


template <int dim>
unsigned int NonlinearRock<dim>::find_active(const State &state)
{
  active.clear();
  visit(state, [&](const CellIterator &cell) { active.push_back(cell); });
  return active.size();
}


template <int dim>
void NonlinearRock<dim>::assemble(const StepContext &context, const State &state, Sink &sink)
{
  LocalSystem local;
  for (const CellIterator &cell : active)
  {
    evaluator->reinit(cell, role(cell).cut);
    find_history(cell);
    states_at(cell, state, state.current);
    add_cell(cell, context, state, local);
    sink.add(local);
  }
}


template <int dim>
bool NonlinearRock<dim>::is_symmetric() const
{
  return std::all_of(active.begin(), active.end(),
                     [this](const CellIterator &cell)
                     { return law(cell).is_symmetric() && !law(cell).changes_permeability(); });
}


template <int dim>
void NonlinearRock<dim>::add_energies(const std::vector<SymmetricTensor<2, 3>> &stress_before,
                                      const std::vector<SymmetricTensor<2, 3>> &stress_now,
                                      const State &state)
{
  const auto &layout = evaluator->layout;
  const auto &constraints = mesh_view->constraints;
  for (unsigned int i = 0; i < layout.u.size(); ++i)
  {
    const auto dof = evaluator->dofs()[layout.u[i]];
    if (!constraints.is_constrained(dof))
      continue;
    const double now = prescribed_part(constraints, dof, state.current.bulk),
                 moved = now - prescribed_part(constraints, dof, state.committed.bulk);
    for (unsigned int q = 0; q < stress_now.size(); ++q)
    {
      Tensor<2, 3> gradient;
      for (unsigned int d = 0; d < dim; ++d)
        gradient[evaluator->component(i)][d] = evaluator->gradient(i, q)[d];
      const SymmetricTensor<2, 3> strain = evaluator->weight(q) * symmetrize(gradient);
      last_totals.held_work_beyond += 0.5 * moved * ((stress_before[q] + stress_now[q]) * strain);
      last_totals.held_force_beyond += now * (stress_now[q] * strain);
    }
  }
}


template <int dim>
void NonlinearRock<dim>::commit_cell(const CellIterator &cell,
                                     const StepContext &context,
                                     const State &state)
{
  const RockLaw &law = this->law(cell);
  const RockProperties &rock = scene.rock(cell->material_id());
  const std::vector<RockState> now = states;
  const auto evaluate = [&](const std::vector<RockState> &at, std::vector<RockResponse> &result)
  {
    law.evaluate(make_array_view(at.cbegin(), at.cend()),
                 make_array_view(result.begin(), result.end()));
  };
  const unsigned int n = points->n_values();
  std::vector<double> values(now.size() * n, 0.);
  responses.assign(now.size(), RockResponse());
  for (unsigned int q = 0; q < now.size(); ++q)
    responses[q].history = &values[q * n + n_core];
  evaluate(now, responses);
  states_at(cell, state, state.committed);
  std::vector<RockResponse> before(now.size());
  evaluate(states, before);

  const bool flows = law.changes_permeability() && evaluator->layout.n_p > 0;
  if (flows)
    evaluator->pressure_gradient(state.current, pressure_gradients);

  bool stores_more = false;
  std::vector<SymmetricTensor<2, 3>> beyond_before(now.size()), beyond_now(now.size());
  for (unsigned int q = 0; q < now.size(); ++q)
  {
    const double w = evaluator->weight(q);
    const RockResponse linear = linear_response(rock, now[q]);
    beyond_before[q] = before[q].stress - linear_response(rock, states[q]).stress;
    beyond_now[q] = responses[q].stress - linear.stress;

    double *core = &values[q * n];
    core[content_beyond] = responses[q].content - linear.content;
    stores_more |= core[content_beyond] != 0.;
    // What the work of stress and pressure leaves beside the stored energy, by the trapezoidal
    // rule. It closes the audit, whose work is by the same rule, and knows nothing of what the load
    // did within the step; the law may know better what is dissipated.
    const auto mean_stress = now[q].in_situ_stress + 0.5 * (before[q].stress + responses[q].stress);
    const double mean_pressure =
      now[q].in_situ_pressure + 0.5 * (states[q].pressure + now[q].pressure);
    const double left = mean_stress * (now[q].strain - states[q].strain) +
                        mean_pressure * (responses[q].content - before[q].content) -
                        (responses[q].energy - before[q].energy);
    const auto so_far = [&](const CoreNumber number)
    { return committed[q] != nullptr ? committed[q][number] : 0.; };
    core[not_stored] = so_far(not_stored) + left;
    core[dissipated] =
      so_far(dissipated) + (std::isnan(responses[q].dissipated) ? left : responses[q].dissipated);

    last_totals.content += w * core[content_beyond];
    const double gained = w * (core[content_beyond] - so_far(content_beyond));
    last_totals.content_change += gained;
    const Tensor<1, dim> flow =
      flows ? Tensor<1, dim>(context.effective_dt() * w *
                             (mobility_beyond(rock, q) * pressure_gradients[q]))
            : Tensor<1, dim>();
    for (unsigned int a = 0; a < evaluator->layout.n_p; ++a)
      last_totals.outflow -=
        prescribed_share(mesh_view->constraints, evaluator->dofs()[evaluator->layout.p[a]]) *
        (evaluator->pressure_value(a, q) * gained + evaluator->pressure_gradient(a, q) * flow);
    last_totals.dissipated_energy += w * core[dissipated];
    last_totals.work_not_stored += w * core[not_stored];
    if (responses[q].remark != nullptr)
      last_totals.remarks.insert(responses[q].remark);
    last_totals.stored_energy_beyond +=
      w * (responses[q].energy - 0.5 * (linear.stress * now[q].strain));
    if (std::any_of(core + n_core, core + n, [](const double v) { return v != 0.; }))
      last_totals.yielded_volume += w;
  }
  add_energies(beyond_before, beyond_now, state);
  // A law without history, and linear but for its permeability, needs nothing kept.
  if (law.n_history() > 0 || points->has(cell->active_cell_index()) || stores_more)
    points->set(cell->active_cell_index(), evaluator->unit_points(), values);
}


template <int dim>
void NonlinearRock<dim>::commit(const StepContext &context, const State &state)
{
  last_totals = Totals();
  visit(state, [&](const CellIterator &cell) { commit_cell(cell, context, state); });
  look_around(state, state.current);
}


template <int dim>
typename NonlinearRock<dim>::Answer NonlinearRock<dim>::at(const CellIterator &cell,
                                                           const Point<dim> &unit_point,
                                                           const Point<dim> &point,
                                                           const SymmetricTensor<2, dim> &strain,
                                                           const double pressure,
                                                           const State &now) const
{
  const RockLaw &law = this->law(cell);
  const double *known = points->nearest(cell->active_cell_index(), unit_point, role(cell).cut);
  RockState state;
  state.strain = in_space(strain);
  state.pressure = pressure;
  state.in_situ_stress = scene.in_situ_tensor(point, scene.rock(cell->material_id()));
  state.in_situ_pressure = scene.in_situ_pore_pressure(point);
  state.history = known != nullptr ? known + n_core : nullptr;
  if (const auto segment = role(cell).segment)
    state.fracture_pressure = now.pressure_of(*segment, now.current);
  Answer answer;
  answer.history.assign(law.n_history(), 0.);
  if (known == nullptr && law.used(state) < 1. && !law.changes_permeability())
  {
    answer.stress = linear_response(scene.rock(cell->material_id()), state).stress;
    return answer;
  }
  RockResponse response;
  law.evaluate(ArrayView<const RockState>(&state, 1), ArrayView<RockResponse>(&response, 1));
  answer.stress = response.stress;
  if (law.changes_permeability())
    answer.permeability = response.permeability;
  if (known != nullptr)
  {
    answer.history.assign(known + n_core, known + n_core + answer.history.size());
    answer.dissipated_energy = known[dissipated];
  }
  return answer;
}


template class NonlinearRock<2>;
template class NonlinearRock<3>;
} // namespace stockwork
