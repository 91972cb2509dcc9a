#include "report.h"

#include "coupling/mechanical_energy.h"
#include "flow/segment_graph.h"

#include "stockwork/base/progress.h"
#include "stockwork/base/quantity.h"

#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace stockwork
{
using namespace dealii;

template <int dim>
Report<dim>::Report(RunContext &run,
                    const CoupledSystem<dim> &system,
                    const Stepper<dim> &stepper,
                    const FractureModel<dim> &model,
                    const Network<dim> &network,
                    const InSitu<dim> &in_situ,
                    const Rock &rock,
                    const bool audits_energy,
                    const Mapping<dim> &mapping,
                    const ReferenceSolution<dim> *reference,
                    const StepControl &control,
                    const std::string &directory)
  : run(run)
  , system(system)
  , stepper(stepper)
  , model(model)
  , network(network)
  , in_situ(in_situ)
  , rock(rock)
  , audits_energy(audits_energy)
  , mapping(mapping)
  , reference(reference)
  , control(control)
  , directory(directory)
  , start_of_run(control.start_time)
{
  if (reference)
    errors = std::make_unique<ErrorRecord<dim>>(*reference, control.start_time, control.end_time);
}


template <int dim>
void Report<dim>::open(const bool restarted, const double time)
{
  start_of_run = time;
  if (run.rank == 0)
  {
    const std::string file = directory + "/statistics.csv";
    if (restarted)
      statistics.continue_from(file, time);
    else
      statistics.open(file);
  }
}


template <int dim>
void Report<dim>::header() const
{
  run.out << progress_header(dim) << std::endl;
}


template <int dim>
void Report<dim>::observe_fracture(const FractureSummary &summary, Values &values)
{
  values["fracture_length"] = summary.length;
  values["broken_length"] = summary.broken_length;
  values["equivalent_length"] =
    summary.equivalent_length.value_or(0.5 * (summary.length + summary.broken_length));
  values["dissipated_energy"] = summary.dissipated_energy;
  if (summary.stress_intensity_I)
    values["stress_intensity_I"] = *summary.stress_intensity_I;
  if (summary.stress_intensity_II)
    values["stress_intensity_II"] = *summary.stress_intensity_II;
  if (summary.energy_release_rate)
    values["energy_release_rate"] = *summary.energy_release_rate;
  cost_of_fracture = summary.cost;
  shown.n_tips = summary.n_tips;
  shown.length = summary.length;
  shown.process_zone = summary.length - summary.broken_length;
  shown.grown_to(summary.length, stepper.last_context().time,
                 0.01 * (control.end_time - control.start_time));
}


template <int dim>
double Report<dim>::observe_rock(Values &values) const
{
  const NonlinearRock<dim> *const rock_beyond = system.nonlinear_rock();
  if (rock_beyond == nullptr || !rock_beyond->remembers())
    return 0.;
  const auto &mine = rock_beyond->totals();
  std::vector<double> sums{mine.yielded_volume, mine.dissipated_energy, mine.work_not_stored};
  system.collectives().sum(sums);
  values["yielded_volume"] = sums[0];
  values["rock_dissipated_energy"] = sums[1];
  const double used = system.collectives().max(mine.maximum_used);
  values["maximum_share_of_strength"] = sums[0] > 0. ? 1. : used;
  return sums[2];
}


template <int dim>
void Report<dim>::observe_energy(const State &state,
                                 const FractureSummary &summary,
                                 const double not_stored_in_rock,
                                 Values &values)
{
  MechanicalEnergy energy;
  if (const ExplicitMarch<dim> *const march = stepper.explicit_march())
  {
    // All of the rock is the model's.
    energy.kinetic = march->kinetic_energy();
    energy.work = march->work_of_step();
  }
  else
    energy =
      mechanical_energy<dim>(system.mesh_view(), rock, system.nonlinear_rock(), system.loads(),
                             model, stepper.last_context(), state, system.collectives());
  if (const OpeningControl<dim> *const control = system.opening_control())
  {
    const unsigned int index = system.index_of_control();
    const double before = control->displacement(state.committed, system.collectives());
    values["load_displacement"] = control->displacement(state.current, system.collectives());
    energy.load = control->force(state.current, index);
    energy.work += 0.5 * (control->force(state.committed, index) + energy.load) *
                   (values["load_displacement"] - before);
  }
  external_work += energy.work;
  if (stepper.last_context().acceleration > 0.)
    values["kinetic_energy"] = energy.kinetic;
  else
  {
    peak_load = std::max(peak_load, energy.load);
    values["load"] = energy.load;
    values["peak_load"] = peak_load;
  }
  values["external_work"] = external_work;
  values["stored_energy"] = energy.stored + summary.stored_energy;
  if (external_work > 0.)
  {
    values["energy_balance_error"] =
      std::abs(external_work - values["stored_energy"] - energy.kinetic -
               summary.dissipated_energy - not_stored_in_rock) /
      external_work;
    shown.energy_error = values["energy_balance_error"];
  }
  if (external_work > 0. && values.count("rock_dissipated_energy") != 0)
    values["energy_step_error"] =
      std::abs(values["rock_dissipated_energy"] - not_stored_in_rock) / external_work;
}


template <int dim>
void Report<dim>::observe_shape(Values &values) const
{
  if constexpr (dim == 2)
    if (!network.segments().empty())
    {
      const SegmentGraph graph = segment_graph(network.segments());
      values["branches"] = graph.n_branches;
      values["forks"] = graph.fork_angles.size();
      values["fork_angle"] =
        std::accumulate(graph.fork_angles.begin(), graph.fork_angles.end(), 0.) /
        std::max<std::size_t>(graph.fork_angles.size(), 1);
    }
  for (unsigned int d = 0; d < dim && !network.segments().empty(); ++d)
  {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto &segment : network.segments())
    {
      // So far a segment reaches from its centre, in its plane.
      const double half =
        0.5 * segment.size() * std::sqrt(std::max(0., 1. - std::pow(segment.normal[d], 2)));
      low = std::min(low, segment.centre[d] - half);
      high = std::max(high, segment.centre[d] + half);
    }
    values[std::string("extent_") + "xyz"[d]] = high - low;
  }
}


template <int dim>
void Report<dim>::observe_fluid(const State &state, Values &values)
{
  const FluidBalance &balance = stepper.fluid_balance();
  shown.injected = balance.total.injected;
  shown.leaked = balance.total.leaked;
  values["fracture_volume"] = balance.fracture_volume;
  values["injected_volume"] = balance.total.injected - balance.total.outflow;
  values["leaked_volume"] = balance.total.leaked;
  if (!network.segments().empty())
  {
    // Below zero, faces have passed through one another.
    const auto apertures = network.apertures(state.current, system.collectives());
    const auto [least, greatest] = std::minmax_element(apertures.begin(), apertures.end());
    values["minimum_aperture"] = *least;
    values["maximum_aperture"] = *greatest;
    shown.least_opening = std::min(shown.least_opening, *least);
    shown.greatest_opening = std::max(shown.greatest_opening, *greatest);
  }
  const auto wells = network.wells(stepper.last_context(), state, system.collectives());
  if (!wells.empty())
    shown.inlet_pressure = wells[0].inlet_pressure;
  if (!wells.empty() && !network.segments().empty())
  {
    const auto pressures = network.pressures(stepper.committed);
    shown.has_pressure(*std::min_element(pressures.begin(), pressures.end()),
                       stepper.last_context().time);
    values["minimum_pressure"] = shown.minimum_pressure;
  }
  if (!wells.empty() && wells[0].inlet_segment)
  {
    values["inlet_pressure"] = wells[0].inlet_pressure;
    values["inlet_aperture"] = wells[0].inlet_aperture;
    // Over the in-situ stress across the fracture, which is what analytical solutions call p.
    const auto &inlet = network.segments()[*wells[0].inlet_segment];
    values["net_inlet_pressure"] =
      wells[0].inlet_pressure + inlet.normal * (in_situ.stress(inlet.centre) * inlet.normal);
    watch(wells[0], values["net_inlet_pressure"]);
  }
  for (unsigned int w = 0; w < wells.size(); ++w)
    observe_well(w, wells[w], wells.size() == 1, values);
}


template <int dim>
void Report<dim>::observe_well(const unsigned int w,
                               const WellReport &report,
                               const bool is_alone,
                               Values &values)
{
  const std::string well = "well_" + std::to_string(w + 1);
  if (!std::isnan(report.borehole_pressure))
    values[well + "_borehole_pressure"] = report.borehole_pressure;
  if (!report.inlet_segment)
    values[well + "_pore_pressure"] = report.inlet_pressure; // mean about its first perforation
  values[well + "_rate"] = report.rate;
  values[well + "_wanted_rate"] = report.wanted_rate;
  // How the fluid is shared.
  if (!is_alone || report.perforation_rates.size() > 1)
    for (unsigned int i = 0; i < report.perforation_rates.size(); ++i)
      values[well + "_perforation_" + std::to_string(i + 1) + "_rate"] =
        report.perforation_rates[i];
  if (report.is_reached && reached_wells.insert(w).second)
  {
    std::ostringstream text;
    text << "From t = " << stepper.last_context().time
         << " s on, a fracture has come into the rock about the well '" << report.name
         << "' that its fluid is spread over: the pressure in its borehole is that in intact rock.";
    run.warn(text.str());
  }
  const double highest = std::isnan(report.borehole_pressure)
                           ? report.inlet_pressure
                           : std::max(report.borehole_pressure, report.inlet_pressure);
  if (report.least_stress > 0. && highest > report.least_stress &&
      fracturing_wells.insert(w).second)
  {
    std::ostringstream text;
    text << "From t = " << stepper.last_context().time << " s on, the pressure at the well '"
         << report.name << "', " << to_string(highest, dimension::pressure)
         << ", is above the least compressive stress in situ, "
         << to_string(report.least_stress, dimension::pressure)
         << ": it would fracture the rock, which this run does not know.";
    run.warn(text.str());
  }
  if (report.rate > report.wanted_rate && dry_wells.insert(w).second)
  {
    std::ostringstream text;
    text << "From t = " << stepper.last_context().time << " s on, the well '" << report.name
         << "' gives less than it should, " << -report.rate << " of " << -report.wanted_rate
         << (dim == 2 ? " m^2/s" : " m^3/s") << " in the model: its pressure is at its least, "
         << report.borehole_pressure << " Pa.";
    run.warn(text.str());
  }
}


template <int dim>
typename Report<dim>::Values Report<dim>::observe()
{
  Values values;
  const State state = stepper.last_state();
  const FractureSummary summary = model.summary(state, system.collectives());
  observe_fracture(summary, values);
  const double not_stored_in_rock = observe_rock(values);
  if (audits_energy)
    observe_energy(state, summary, not_stored_in_rock, values);
  if (reference && reference->place_of_displacement())
  {
    const auto displacement = displacement_at(*reference->place_of_displacement());
    for (unsigned int d = 0; d < dim; ++d)
      values[std::string("displacement_") + "xyz"[d]] = displacement[d];
  }
  if (reference)
    reference->add_derived(values);
  observe_shape(values);
  observe_fluid(state, values);
  return values;
}


template <int dim>
Tensor<1, dim> Report<dim>::displacement_at(const Point<dim> &point) const
{
  const DoFHandler<dim> &dofs = system.bulk_dofs();
  std::vector<double> found(dim, -std::numeric_limits<double>::infinity());
  Vector<double> values(dofs.get_fe().n_components());
  try
  {
    VectorTools::point_value(mapping, dofs, stepper.committed.bulk, point, values);
    for (unsigned int d = 0; d < dim; ++d)
      found[d] = values(d);
  }
  catch (const VectorTools::ExcPointNotAvailableHere &)
  {
  }
  Tensor<1, dim> displacement;
  for (unsigned int d = 0; d < dim; ++d)
    displacement[d] = system.collectives().max(found[d]);
  return displacement;
}


template <int dim>
void Report<dim>::watch(const WellReport &well, const double net_pressure)
{
  const std::string now = " at t = " + std::to_string(stepper.last_context().time) + " s.";
  // Faces in contact overlap a little, for they touch by a penalty.
  maximum_inlet_aperture = std::max(maximum_inlet_aperture, well.inlet_aperture);
  greatest_rate = std::max(greatest_rate, std::abs(well.wanted_rate));
  // While the wells rest, what is left of closed faces is rounding.
  const double open = std::max(maximum_inlet_aperture, network.smallest_hydraulic_aperture());
  if (well.inlet_aperture < -0.01 * open && !warned_of_aperture)
  {
    warned_of_aperture = true;
    run.warn("The aperture at the inlet is negative (" +
             to_string(well.inlet_aperture, dimension::length) +
             "): the faces of the fracture overlap there" + now);
  }
  const double volume = stepper.fluid_balance().fracture_volume;
  if (volume < -1e-3 * open * shown.length && !warned_of_volume)
  {
    warned_of_volume = true;
    run.warn("The fracture holds less than nothing: its faces overlap by " +
             to_string(-volume / shown.length, dimension::length) +
             " on the average, and more fluid has left it than came" + now);
  }
  const RockProperties &main = rock.main();
  const double wing = shown.length / std::max(shown.n_tips, 1u);
  if (warned_of_pressure || dim != 2 || !(wing > 0.) || std::isnan(main.energy_release_rate))
    return;
  // What opens a crack of this length against toughness, what the flow along it takes, and what a
  // short one needs besides to part the rock; three times that is far above all of them.
  const double aperture = std::max({well.inlet_aperture, volume / shown.length, 1e-12});
  // After shut-in the fluid goes on from where the fracture is wide to where it is narrow.
  const double flow = 12. * rock.fluid().viscosity * greatest_rate * wing / std::pow(aperture, 3);
  const double strength = std::isnan(main.tensile_strength) ? 0. : main.tensile_strength;
  const double needed = main.toughness() / std::sqrt(numbers::PI * wing) + flow + strength;
  if (net_pressure > 3. * needed)
  {
    warned_of_pressure = true;
    run.warn("The pressure at the inlet is " + to_string(net_pressure, dimension::pressure) +
             " above the in-situ stress, where toughness, strength and flow of a fracture of this "
             "length account for " +
             to_string(needed, dimension::pressure) + now);
  }
}


template <int dim>
double Report<dim>::pore_balance_error(const typename CoupledSystem<dim>::PoreFluid &pores) const
{
  if (!network.opens_into_rock())
    return 0.;
  // What pores gain and lose is over the time of the scheme.
  const StepContext &context = stepper.last_context();
  const FluidVolumes &step = stepper.fluid_balance().step;
  const FluidVolumes &total = stepper.fluid_balance().total;
  const double from_fractures = network.leaks_into_pores() ? step.leaked : 0.;
  const double scheme = context.effective_dt() / context.dt;
  const double entered = scheme * (step.in_rock + from_fractures);
  const double moved = std::max(
    {std::abs(step.in_rock), std::abs(from_fractures), std::abs(pores.stored), pores.through,
     context.time > control.start_time
       ? (total.injected + total.outflow) * context.dt / (context.time - control.start_time)
       : 0.});
  return moved > 0. ? std::abs(entered - pores.stored - pores.outflow) / moved : 0.;
}


template <int dim>
void Report<dim>::add_step(const unsigned int step, const StepReport &step_report)
{
  const auto scope = run.timers.scope("output");
  const double time = stepper.last_context().time;
  auto observed = observe();
  const auto pores = system.pore_fluid(stepper.last_context(), stepper.last_state());
  double balance_error =
    std::max(stepper.fluid_balance().relative_error, pore_balance_error(pores));
  if (system.restarts())
  {
    // Of both books together: what the one has too much, the other may lack.
    const FluidVolumes &total = stepper.fluid_balance().total;
    const double lost =
      total.defect() + total.leaked + total.in_rock - pores.stored - pores.outflow;
    observed["lost_volume"] = lost;
    const double moved = total.injected + total.outflow;
    balance_error = moved > 0. ? std::abs(lost) / moved : 0.;
  }

  shown.held_back = step_report.held_back;
  ++summary.steps;
  ++steps_of_run;
  summary.rejected_steps += step_report.rejected;
  summary.nonlinear_iterations += step_report.nonlinear_iterations;
  summary.linear_iterations += step_report.linear_iterations;
  // Pores are balanced over the time of the scheme.
  const double scheme = stepper.last_context().dt / stepper.last_context().effective_dt();
  if (system.restarts())
    summary.fluid_balance.stored = summary.fluid_balance.outflow = 0.;
  summary.fluid_balance.stored += scheme * pores.stored;
  summary.fluid_balance.outflow += scheme * pores.outflow + stepper.fluid_balance().step.outflow;
  summary.fluid_balance.relative_error =
    std::max(summary.fluid_balance.relative_error, balance_error);

  if (system.bulk_dofs().get_fe().n_components() > dim)
  {
    observed["pore_volume"] = pores.volume;
    // Of what was injected, what is neither in fractures nor in boreholes nor in pores by their
    // volumes as they are, nor has left; where what leaks off stays in the model. The compression
    // of the fluid in fractures is in it, and with BDF2 what the sum of its rates over the steps
    // is off the volume.
    const FluidBalance &balance = stepper.fluid_balance();
    if (network.leaks_into_pores() || balance.total.leaked == 0.)
      observed["fluid_volume_defect"] = balance.total.injected - summary.fluid_balance.outflow -
                                        balance.fracture_volume - balance.total.in_boreholes -
                                        pores.volume;
  }

  const auto set = [this](const std::string &name, const double value)
  { statistics.set(name, value, unit_of_column(name, dim)); };
  set("step", step);
  set("time", time);
  set("time_step", step_report.dt);
  for (const auto &[name, value] : observed)
    set(name, value);
  set("fluid_balance_error", balance_error);
  if (errors)
  {
    const auto scope = run.timers.scope("verification");
    errors->add_fields(time, step_report.dt, mapping, system.bulk_dofs(), stepper.committed,
                       [this](const auto &cell) { return model.role(cell); });
    errors->add_values(time, step_report.dt, observed);
    if (errors->compares(time))
      for (const auto &[name, error] : errors->errors())
        set("error_" + name, error.final);
    if (reference->reaches(time))
      for (const auto &[name, value] : reference->values(time))
        set("reference_" + name, value);
  }
  statistics.end_row();

  Progress progress;
  progress.step = step;
  progress.time = time;
  progress.start_time = control.start_time;
  progress.end_time = control.end_time;
  progress.time_step = step_report.dt;
  progress.nonlinear_iterations = step_report.nonlinear_iterations;
  progress.linear_iterations = step_report.linear_iterations;
  progress.rejected = step_report.rejected;
  if (system.extra_numbering().size() > 0 && !network.segments().empty())
    progress.fracture_length = observed.at("fracture_length");
  if (system.extra_numbering().size() > 0 || network.has_wells())
    progress.fluid_balance = balance_error;
  if (observed.count("inlet_aperture"))
    progress.inlet_aperture = observed.at("inlet_aperture");
  progress.inlet_pressure = shown.inlet_pressure;
  progress.wall_seconds = run.timers.total();
  progress.fraction_at_start =
    (start_of_run - control.start_time) / (control.end_time - control.start_time);
  run.out << progress_line(progress) << std::endl;
}


template <int dim>
void Report<dim>::say_what_is_lost() const
{
  const FluidVolumes &total = stepper.fluid_balance().total;
  if (!system.restarts() || !(total.injected > 0.))
    return;
  const auto last = statistics.final_values();
  const auto lost = last.find("lost_volume");
  if (lost == last.end())
    return;
  std::ostringstream text;
  text << "Coupling as published: of the " << total.injected << (dim == 2 ? " m^2" : " m^3")
       << " injected, " << 100. * (total.injected - lost->second) / total.injected
       << " per cent are in the fracture"
       << (system.bulk_dofs().get_fe().n_components() > dim ? " and in the pores" : "")
       << ", and the difference is lost (lost_volume).";
  run.warn(text.str());
}


template <int dim>
void Report<dim>::fail(const unsigned long n_cells, const std::string &reason)
{
  summary.status = "failed";
  summary.reason = reason;
  say_what_is_lost();
  summarise(n_cells);
}


template <int dim>
void Report<dim>::summarise(const unsigned long n_cells)
{
  for (const auto &[name, value] : statistics.final_values())
    summary.final_values[name] = value;
  if (errors)
    for (const auto &[name, error] : errors->errors())
      summary.errors[name] = {error.final, error.mean(), reference->name()};
  for (unsigned int k = 0; errors && k < reference->wrong_factors.size(); ++k)
    for (const auto &[name, error] : errors->errors_against(k))
      summary.errors_against[reference->wrong_factors[k]][name] = {error.final, error.mean(),
                                                                   reference->name()};
  const FluidVolumes &total = stepper.fluid_balance().total;
  summary.case_name = case_name;
  summary.fracture_model = model_name;
  summary.deck = deck;
  summary.before_physics = before_physics;
  summary.machine = machine();
  summary.date = utc_date();
  summary.ranks = run.n_ranks;
  summary.fluid_balance.injected = total.injected;
  summary.fluid_balance.in_fractures = total.in_fractures;
  summary.fluid_balance.leaked = total.leaked;
  summary.cells = n_cells;
  summary.unknowns = system.n_unknowns();
  summary.wall_seconds = run.timers.seconds(run.communicator);
  summary.cpu_seconds = cpu_seconds(run.communicator);
  summary.peak_memory_bytes = peak_memory(run.communicator);
  summary.warnings = run.warnings;
  if (run.rank == 0)
    write_summary(directory + "/summary.json", summary);
}


template <int dim>
void Report<dim>::finish(const unsigned long n_cells)
{
  say_what_is_lost();
  summarise(n_cells);
  if (!cost_of_fracture.empty())
    run.out << '\n' << cost_of_fracture << ".\n";
  if (const std::string choices = system.solver_choices(); !choices.empty())
    run.out << "Linear systems ('Linear solver/Type = auto'): " << choices << ".\n";
  run.timers.print(run.out.get_stream(), run.communicator, steps_of_run);
  const bool to_the_end = !reference || reference->reaches(control.end_time);
  const std::string when = to_the_end ? " % at the end, " : " % where the reference ends, ";
  for (const auto &[name, error] : summary.errors)
    run.out << "error of " << name << ": " << 100. * error.final << when << 100. * error.mean
            << " % on average (" << error.reference << ")\n";
  run.out << std::flush;
}


template class Report<2>;
template class Report<3>;
} // namespace stockwork
