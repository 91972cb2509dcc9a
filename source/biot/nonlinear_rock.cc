#include "biot/nonlinear_rock.h"

#include "stockwork/rock/linear_stiffness.h"

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


template <int dim>
SymmetricTensor<2, 3> in_space(const SymmetricTensor<2, dim> &t)
{
  SymmetricTensor<2, 3> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      result[i][j] = t[i][j];
  return result;
}


template <int dim>
SymmetricTensor<2, dim> in_plane(const SymmetricTensor<2, 3> &t)
{
  SymmetricTensor<2, dim> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      result[i][j] = t[i][j];
  return result;
}


template <int dim>
SymmetricTensor<4, dim> in_plane(const SymmetricTensor<4, 3> &t)
{
  SymmetricTensor<4, dim> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      for (unsigned int k = 0; k < dim; ++k)
        for (unsigned int l = k; l < dim; ++l)
          result[i][j][k][l] = t[i][j][k][l];
  return result;
}


/// What rock in its linear range answers.
RockResponse linear_response(const RockProperties &rock, const RockState &state)
{
  const auto identity = unit_symmetric_tensor<3>();
  const LinearStiffness<3> hooke(rock);
  RockResponse response;
  response.stress_by_strain = hooke.tensor();
  response.stress_by_pressure = -rock.biot_coefficient * identity;
  response.content_by_strain = rock.biot_coefficient * identity;
  response.content_by_pressure = rock.inverse_biot_modulus;
  response.stress = hooke.stress(state.strain) + state.pressure * response.stress_by_pressure;
  response.content =
    rock.biot_coefficient * trace(state.strain) + rock.inverse_biot_modulus * state.pressure;
  return response;
}
} // namespace


template <int dim>
NonlinearRock<dim>::NonlinearRock(const RockLaws &laws, const Scene<dim> &scene)
  : laws(laws)
  , scene(scene)
{
}


template <int dim>
void NonlinearRock<dim>::setup(const Discretization<dim> &new_discretization)
{
  discretization = std::make_unique<const Discretization<dim>>(new_discretization);
  const auto &fe = discretization->dof_handler.get_fe();
  const auto quadrature = quadrature_of(fe);
  evaluator = std::make_unique<CellEvaluator<dim>>(discretization->mapping, fe, quadrature);
  if (!points)
  {
    unsigned int n = 0;
    for (const auto &[region, law] : laws.all())
      n = std::max(n, law->n_history());
    points = std::make_unique<PointHistory<dim>>(n_core + n, quadrature.get_points());
    points->reinit(discretization->dof_handler.get_triangulation().n_active_cells());
  }
  watched.clear();
  for (const auto &cell : discretization->dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && answers(cell))
      watched.push_back({cell, 0., 0.});
  has_looked = false;
}


template <int dim>
typename NonlinearRock<dim>::InSituShare NonlinearRock<dim>::in_situ_share()
{
  InSituShare share;
  for (const auto &cell : discretization->dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && answers(cell))
    {
      evaluator->reinit(cell, nullptr);
      for (unsigned int q = 0; q < evaluator->n_points(); ++q)
      {
        const Point<dim> &x = evaluator->point(q);
        RockState state;
        state.in_situ_stress = scene.in_situ_tensor(x, scene.rock(cell->material_id()));
        state.in_situ_pressure = scene.in_situ_pore_pressure(x);
        const double used = laws(cell->material_id()).used(state);
        if (used > share.used)
          share = {used, x};
      }
    }
  return share;
}


template <int dim>
void NonlinearRock<dim>::states_at(const CellIterator &cell, const Unknowns &unknowns)
{
  const RockProperties &rock = scene.rock(cell->material_id());
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
    states[q].history = committed[q] != nullptr ? committed[q] + n_core : nullptr;
  }
}


template <int dim>
void NonlinearRock<dim>::find_history(const CellIterator &cell)
{
  const unsigned int index = cell->active_cell_index();
  committed.assign(evaluator->n_points(), nullptr);
  if (points->has(index))
    for (unsigned int q = 0; q < committed.size(); ++q)
      committed[q] = points->nearest(index, evaluator->unit_points()[q]);
}


namespace
{
/// The greatest change of an unknown of a block, ghosts included.
double greatest_change(const TrilinosWrappers::MPI::Vector &now,
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
void NonlinearRock<dim>::look_around(const Unknowns &unknowns, const Role &role)
{
  last_totals.greatest_used = 0.;
  for (Watched &item : watched)
  {
    const RockLaw &law = laws(item.cell->material_id());
    evaluator->reinit(item.cell, role(item.cell).cut);
    find_history(item.cell);
    states_at(item.cell, unknowns);
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
        last_totals.greatest_used = std::max(last_totals.greatest_used, law.used(states[q]));
    }
    // |stress| <= max(3 K, 2 G) |strain| with |strain| <= sum_a |grad N_a| |u_a|.
    const RockProperties &rock = scene.rock(item.cell->material_id());
    const double shear = 2. * rock.shear_modulus();
    item.slope =
      std::max(3. * rock.lame_lambda() + shear, shear) * steepest * std::sqrt(double(dim));
  }
  looked_at = unknowns.bulk;
  has_looked = true;
}


template <int dim>
template <class Use>
void NonlinearRock<dim>::visit(const State &state, const Role &role, const Use &use)
{
  if (!has_looked)
    look_around(state.committed, role);
  const auto &now = state.current.bulk;
  const double moved = greatest_change(now.block(0), looked_at.block(0)),
               pressed =
                 now.n_blocks() > 1 ? greatest_change(now.block(1), looked_at.block(1)) : 0.;
  for (const Watched &item : watched)
  {
    const CutCell<dim> *const cut = role(item.cell).cut;
    const bool has_history = points->has(item.cell->active_cell_index());
    if (!has_history && cut == nullptr &&
        item.slope * moved + std::sqrt(3.) * pressed < item.margin)
      continue;
    evaluator->reinit(item.cell, cut);
    find_history(item.cell);
    states_at(item.cell, state.current);
    const RockLaw &law = laws(item.cell->material_id());
    if (has_history || std::any_of(states.begin(), states.end(),
                                   [&](const RockState &s) { return law.margin(s) <= 0.; }))
      use(item.cell);
  }
}


template <int dim>
void NonlinearRock<dim>::add_cell(const CellIterator &cell,
                                  const bool with_matrix,
                                  LocalSystem &local)
{
  const RockProperties &rock = scene.rock(cell->material_id());
  const auto &layout = evaluator->layout;
  const unsigned int n_bulk = evaluator->dofs().size(), n = evaluator->n_functions();
  const auto place = [&](const unsigned int function)
  { return function < layout.u.size() ? layout.u[function] : n_bulk + function - layout.u.size(); };

  local.bulk = evaluator->dofs();
  local.extra = evaluator->extra();
  local.reinit();
  responses.assign(states.size(), RockResponse());
  laws(cell->material_id())
    .evaluate(make_array_view(states.cbegin(), states.cend()),
              make_array_view(responses.begin(), responses.end()));

  for (unsigned int q = 0; q < states.size(); ++q)
  {
    const double w = evaluator->weight(q);
    const RockResponse &response = responses[q], linear = linear_response(rock, states[q]);
    const Tensor<2, dim> stress = in_plane<dim>(response.stress - linear.stress);
    for (unsigned int i = 0; i < n; ++i)
      local.residual(place(i)) += stress[evaluator->component(i)] * evaluator->gradient(i, q) * w;
    const double content = response.content - linear.content -
                           (committed[q] != nullptr ? committed[q][content_beyond] : 0.);
    for (unsigned int a = 0; a < layout.n_p; ++a)
      local.residual(layout.p[a]) -= evaluator->pressure_value(a, q) * content * w;
    if (!with_matrix)
      continue;

    const auto stiffness = in_plane<dim>(response.stress_by_strain - linear.stress_by_strain);
    const Tensor<2, dim> by_pressure =
      in_plane<dim>(response.stress_by_pressure - linear.stress_by_pressure);
    const Tensor<2, dim> by_strain =
      in_plane<dim>(response.content_by_strain - linear.content_by_strain);
    const double storage = response.content_by_pressure - linear.content_by_pressure;
    for (unsigned int j = 0; j < n; ++j)
    {
      Tensor<2, dim> gradient;
      gradient[evaluator->component(j)] = evaluator->gradient(j, q);
      const Tensor<2, dim> change = w * (stiffness * symmetrize(gradient));
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
}


template <int dim>
unsigned int NonlinearRock<dim>::find_active(const State &state, const Role &role)
{
  active.clear();
  visit(state, role, [&](const CellIterator &cell) { active.push_back(cell); });
  return active.size();
}


template <int dim>
void NonlinearRock<dim>::assemble(const State &state, const Role &role, Sink &sink)
{
  LocalSystem local;
  for (const CellIterator &cell : active)
  {
    evaluator->reinit(cell, role(cell).cut);
    find_history(cell);
    states_at(cell, state.current);
    add_cell(cell, sink.wants_matrix(), local);
    sink.add(local);
  }
}


template <int dim>
bool NonlinearRock<dim>::is_symmetric() const
{
  return std::all_of(active.begin(), active.end(),
                     [this](const CellIterator &cell)
                     { return laws(cell->material_id()).is_symmetric(); });
}


template <int dim>
void NonlinearRock<dim>::add_energies(const std::vector<SymmetricTensor<2, 3>> &stress_before,
                                      const std::vector<SymmetricTensor<2, 3>> &stress_now,
                                      const State &state)
{
  const auto &layout = evaluator->layout;
  const auto &constraints = discretization->constraints;
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
void NonlinearRock<dim>::commit_cell(const CellIterator &cell, const State &state)
{
  const RockLaw &law = laws(cell->material_id());
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
  states_at(cell, state.committed);
  std::vector<RockResponse> before(now.size());
  evaluate(states, before);

  std::vector<SymmetricTensor<2, 3>> beyond_before(now.size()), beyond_now(now.size());
  for (unsigned int q = 0; q < now.size(); ++q)
  {
    const double w = evaluator->weight(q);
    const RockResponse linear = linear_response(rock, now[q]);
    beyond_before[q] = before[q].stress - linear_response(rock, states[q]).stress;
    beyond_now[q] = responses[q].stress - linear.stress;

    double *core = &values[q * n];
    core[content_beyond] = responses[q].content - linear.content;
    // What the work of stress and pressure leaves beside the stored energy, by the trapezoidal
    // rule.
    const auto mean_stress = now[q].in_situ_stress + 0.5 * (before[q].stress + responses[q].stress);
    const double mean_pressure =
      now[q].in_situ_pressure + 0.5 * (states[q].pressure + now[q].pressure);
    core[dissipated] = (committed[q] != nullptr ? committed[q][dissipated] : 0.) +
                       mean_stress * (now[q].strain - states[q].strain) +
                       mean_pressure * (responses[q].content - before[q].content) -
                       (responses[q].energy - before[q].energy);

    last_totals.content += w * core[content_beyond];
    const double gained =
      w * (core[content_beyond] - (committed[q] != nullptr ? committed[q][content_beyond] : 0.));
    last_totals.content_change += gained;
    for (unsigned int a = 0; a < evaluator->layout.n_p; ++a)
      last_totals.outflow -=
        prescribed_share(discretization->constraints, evaluator->dofs()[evaluator->layout.p[a]]) *
        evaluator->pressure_value(a, q) * gained;
    last_totals.dissipated_energy += w * core[dissipated];
    if (responses[q].remark != nullptr)
      last_totals.remarks.insert(responses[q].remark);
    last_totals.stored_energy_beyond +=
      w * (responses[q].energy - 0.5 * (linear.stress * now[q].strain));
    if (std::any_of(core + n_core, core + n, [](const double v) { return v != 0.; }))
      last_totals.yielded_volume += w;
  }
  add_energies(beyond_before, beyond_now, state);
  points->set(cell->active_cell_index(), evaluator->unit_points(), values);
}


template <int dim>
void NonlinearRock<dim>::commit(const State &state, const Role &role)
{
  last_totals = Totals();
  visit(state, role, [&](const CellIterator &cell) { commit_cell(cell, state); });
  look_around(state.current, role);
}


template <int dim>
typename NonlinearRock<dim>::Answer NonlinearRock<dim>::at(const CellIterator &cell,
                                                           const Point<dim> &unit_point,
                                                           const Point<dim> &point,
                                                           const SymmetricTensor<2, dim> &strain,
                                                           const double pressure) const
{
  const RockLaw &law = laws(cell->material_id());
  const double *known = points->nearest(cell->active_cell_index(), unit_point);
  RockState state;
  state.strain = in_space(strain);
  state.pressure = pressure;
  state.in_situ_stress = scene.in_situ_tensor(point, scene.rock(cell->material_id()));
  state.in_situ_pressure = scene.in_situ_pore_pressure(point);
  state.history = known != nullptr ? known + n_core : nullptr;
  Answer answer;
  answer.history.assign(law.n_history(), 0.);
  if (known == nullptr && law.used(state) < 1.)
  {
    answer.stress = linear_response(scene.rock(cell->material_id()), state).stress;
    return answer;
  }
  RockResponse response;
  law.evaluate(ArrayView<const RockState>(&state, 1), ArrayView<RockResponse>(&response, 1));
  answer.stress = response.stress;
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
