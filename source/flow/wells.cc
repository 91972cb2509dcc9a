#include "flow/wells.h"

#include <algorithm>
#include <limits>

namespace stockwork
{
template <int dim>
bool Wells<dim>::is_of_rock(const unsigned int index) const
{
  return std::any_of(wells.begin(), wells.end(),
                     [index](const Well &well)
                     {
                       return well.in_rock && index >= well.first_index &&
                              index < well.first_index + well.n_unknowns();
                     });
}


template <int dim>
bool Wells<dim>::feeds(const unsigned int segment) const
{
  for (const Well &well : wells)
    for (const Perforation &perforation : well.perforations)
      if (std::find(perforation.segments.begin(), perforation.segments.end(), segment) !=
          perforation.segments.end())
        return true;
  return false;
}


template <int dim>
std::vector<ExtraUnknown> Wells<dim>::unknowns() const
{
  std::vector<ExtraUnknown> result;
  for (const Well &well : wells)
    for (unsigned int k = 0; k < well.n_unknowns(); ++k)
    {
      ExtraUnknown unknown;
      unknown.key = flow_key(std::uint64_t(well.number) << 32 | k, 2);
      if (k == well.perforations.size())
        unknown.initial = well.initial_pressure;
      result.push_back(unknown);
    }
  return result;
}


template <int dim>
void Wells<dim>::set_offset(unsigned int first_index)
{
  for (Well &well : wells)
  {
    well.first_index = first_index;
    first_index += well.n_unknowns();
  }
}


template <int dim>
double Wells<dim>::mean(const Perforation &perforation, const std::vector<double> &values)
{
  double sum = 0.;
  for (const unsigned int i : perforation.segments)
    sum += values[i];
  return sum / perforation.segments.size();
}


template <int dim>
double Wells<dim>::Well::flow(const StepContext &context,
                              const State &state,
                              const double compressibility) const
{
  double sum = 0.;
  for (unsigned int k = 0; k < perforations.size(); ++k)
    sum += perforation_rate(k, context, state);
  if (!is_direct() && !pressure_control)
    sum += volume * compressibility * context.fracture_pressure_factor() / context.fracture_dt() *
           (state.current.extra[pressure_index()] -
            state.fracture_reference(context).extra[pressure_index()]);
  return sum;
}


template <int dim>
double Wells<dim>::Well::rate(const StepContext &context,
                              const State &state,
                              const double compressibility) const
{
  return pressure_control || is_dry(context, state, compressibility)
           ? flow(context, state, compressibility)
           : given(context);
}


template <int dim>
std::vector<double> Wells<dim>::outside_pressures(const std::vector<double> &segment_pressures,
                                                  const Unknowns &unknowns,
                                                  const Collectives &collectives) const
{
  std::vector<double> result;
  for (const Well &well : wells)
    for (const Perforation &perforation : well.perforations)
      result.push_back(well.in_rock ? value(perforation.source->mean_pressure(), unknowns) : 0.);
  if (any_in_rock())
    collectives.sum(result);
  auto outside = result.begin();
  for (const Well &well : wells)
    for (const Perforation &perforation : well.perforations)
    {
      if (!well.in_rock)
        *outside = mean(perforation, segment_pressures);
      ++outside;
    }
  return result;
}


template <int dim>
void Wells<dim>::assemble_perforation(const Well &well,
                                      const unsigned int k,
                                      const StepContext &context,
                                      const State &state,
                                      const double outside,
                                      const std::vector<unsigned int> &rows,
                                      const bool is_first_rank,
                                      LocalSystem &local) const
{
  const double dt = context.fracture_dt();
  const Perforation &perforation = well.perforations[k];
  const double q = well.perforation_rate(k, context, state);

  // Unknowns: what the perforation opens into, y_k, p_b
  local.bulk.clear();
  local.extra.clear();
  if (well.in_rock)
    local.bulk = perforation.source->mean_pressure().bulk;
  else if (is_first_rank)
    for (const unsigned int i : perforation.segments)
      local.extra.push_back(rows[i]);
  const unsigned int n = local.bulk.size() + local.extra.size();
  if (!well.is_direct())
    local.extra.push_back(well.first_index + k);
  if (!well.is_direct() && !well.pressure_control)
    local.extra.push_back(well.pressure_index());
  local.reinit();

  // The balance of the rock is over the time of its scheme.
  const double dt_outside = well.in_rock ? context.effective_dt() : dt;
  const double c = dt * well.conductance;
  for (unsigned int i = 0; i < n; ++i)
  {
    const double share =
      well.in_rock ? perforation.source->mean_pressure().bulk_coefficients[i] : 1. / n;
    local.residual(i) = dt_outside * q * share;
    if (!well.is_direct())
    {
      local.matrix(i, n) = dt_outside * well.conductance * share;
      local.matrix(n, i) = c * share;
    }
  }
  if (!is_first_rank || well.is_direct())
    return;

  const double borehole_pressure =
    well.pressure_control ? well.given(context) : state.current.extra[well.pressure_index()];
  const double resistance = well.resistance(k);
  local.residual(n) =
    c * (outside - borehole_pressure + resistance * q + well.friction * q * std::abs(q));
  local.matrix(n, n) = c * (resistance + 2. * well.friction * std::abs(q)) * well.conductance;
  if (well.pressure_control)
    return;
  local.matrix(n, n + 1) = -c;
  if (!well.is_dry(context, state, compressibility))
  {
    local.residual(n + 1) = -dt * q;
    local.matrix(n + 1, n) = -c;
  }
}


template <int dim>
void Wells<dim>::assemble_borehole(const Well &well,
                                   const StepContext &context,
                                   const State &state,
                                   LocalSystem &local) const
{
  const double dt = context.fracture_dt();
  const unsigned int index = well.pressure_index();
  // The row of the balance, or that of the pressure, as a volume.
  const bool dry = well.is_dry(context, state, compressibility);
  const double c = dry ? dt * well.conductance
                       : well.volume * compressibility * context.fracture_pressure_factor();
  const double reference =
    dry ? well.minimum_pressure : state.fracture_reference(context).extra[index];
  local.bulk.clear();
  local.extra = {index};
  local.reinit();
  local.residual(0) =
    (dry ? 0. : dt * well.given(context)) - c * (state.current.extra[index] - reference);
  local.matrix(0, 0) = -c;
}


template <int dim>
void Wells<dim>::assemble(const StepContext &context,
                          const State &state,
                          const std::vector<double> &outside,
                          const std::vector<unsigned int> &rows,
                          const bool is_first_rank,
                          Sink &sink) const
{
  LocalSystem local;
  auto pressure = outside.begin();
  for (const Well &well : wells)
  {
    for (unsigned int k = 0; k < well.perforations.size(); ++k)
    {
      assemble_perforation(well, k, context, state, *pressure++, rows, is_first_rank, local);
      if (is_first_rank || !local.bulk.empty())
        sink.add(local);
    }
    if (is_first_rank && !well.is_direct() && !well.pressure_control)
    {
      assemble_borehole(well, context, state, local);
      sink.add(local);
    }
  }
}


template <int dim>
double Wells<dim>::magnitude_of_terms(const StepContext &context,
                                      const State &state,
                                      const std::vector<double> &outside) const
{
  double sum = 0.;
  auto pressure = outside.begin();
  for (const Well &well : wells)
    for (unsigned int k = 0; k < well.perforations.size(); ++k, ++pressure)
      if (well.in_rock && !well.is_direct())
        sum += context.fracture_dt() * well.conductance *
               (2. * std::abs(*pressure) +
                2. * well.resistance(k) * std::abs(well.perforation_rate(k, context, state)));
  return sum;
}


template <int dim>
FluidVolumes Wells<dim>::volumes(const StepContext &context, const State &state) const
{
  FluidVolumes volumes;
  for (const Well &well : wells)
  {
    const double rate = well.rate(context, state, compressibility);
    (rate > 0. ? volumes.injected : volumes.outflow) += std::abs(rate) * context.dt;
    for (unsigned int k = 0; well.in_rock && k < well.perforations.size(); ++k)
      volumes.in_rock += well.perforation_rate(k, context, state) * context.dt;
    if (!well.is_direct() && !well.pressure_control)
    {
      const unsigned int index = well.pressure_index();
      volumes.in_boreholes +=
        well.volume * compressibility *
        (state.current.extra[index] - state.fracture_reference(context).extra[index]) *
        context.fracture_pressure_factor() * context.dt / context.fracture_dt();
    }
  }
  return volumes;
}


template <int dim>
std::vector<WellReport> Wells<dim>::report(const StepContext &context,
                                           const State &state,
                                           const std::vector<double> &apertures,
                                           const std::vector<double> &outside) const
{
  std::vector<WellReport> reports;
  auto pressure = outside.begin();
  for (const Well &well : wells)
  {
    WellReport report;
    report.name = well.name;
    report.rate = well.rate(context, state, compressibility);
    report.wanted_rate = well.pressure_control ? report.rate : well.given(context);
    for (unsigned int k = 0; k < well.perforations.size(); ++k)
      report.perforation_rates.push_back(well.perforation_rate(k, context, state));
    report.inlet_pressure = *pressure;
    report.inlet_aperture = std::numeric_limits<double>::quiet_NaN();
    report.is_reached = well.is_reached;
    report.least_stress = well.least_stress;
    if (!well.in_rock)
    {
      report.inlet_segment = well.perforations[0].segments[0];
      report.inlet_aperture = mean(well.perforations[0], apertures);
    }

    const double q = report.perforation_rates[0];
    report.borehole_pressure =
      well.in_rock && !(well.resistance(0) > 0.)
        ? std::numeric_limits<double>::quiet_NaN()
        : report.inlet_pressure + well.resistance(0) * q + well.friction * q * std::abs(q);
    reports.push_back(std::move(report));
    pressure += well.perforations.size();
  }
  return reports;
}


template <int dim>
std::vector<std::pair<std::string, double>> Wells<dim>::minimum_pressures() const
{
  std::vector<std::pair<std::string, double>> result;
  for (const Well &well : wells)
    if (well.is_bounded())
      result.emplace_back(well.name, well.minimum_pressure);
  return result;
}


template <int dim>
void Wells<dim>::set_scales(const double pressure, const double typical_rate)
{
  for (Well &well : wells)
  {
    const double rate = well.pressure_control ? 0. : well.value.magnitude() * well.fraction;
    well.conductance = (rate > 0. ? rate : typical_rate) / pressure;
  }
}


template <int dim>
double Wells<dim>::maximum_rate() const
{
  double greatest = 0.;
  for (const Well &well : wells)
    if (!well.pressure_control && !well.in_rock)
      greatest = std::max(greatest, well.value.magnitude());
  return greatest;
}


template <int dim>
std::optional<double> Wells<dim>::maximum_pressure() const
{
  std::optional<double> greatest;
  for (const Well &well : wells)
    if (well.pressure_control && !well.in_rock)
      greatest = std::max(greatest.value_or(0.), well.value.magnitude());
  return greatest;
}


template <int dim>
const typename Wells<dim>::Well *Wells<dim>::first_into_fracture() const
{
  const auto first =
    std::find_if(wells.begin(), wells.end(), [](const Well &well) { return !well.in_rock; });
  return first == wells.end() ? nullptr : &*first;
}


template <int dim>
double Wells<dim>::first_rate(const double t) const
{
  const Well *const first = first_into_fracture();
  return first == nullptr || first->pressure_control ? 0. : first->value(t, t);
}


template <int dim>
double Wells<dim>::first_fraction() const
{
  const Well *const first = first_into_fracture();
  return first == nullptr ? 1. : first->fraction;
}


template <int dim>
std::vector<dealii::Point<dim>> Wells<dim>::first_perforations() const
{
  std::vector<dealii::Point<dim>> points;
  if (const Well *const first = first_into_fracture())
    for (const Perforation &perforation : first->perforations)
      points.push_back(perforation.point);
  return points;
}


template <int dim>
std::vector<typename Wells<dim>::SourceInRock> Wells<dim>::sources_in_rock() const
{
  std::vector<SourceInRock> sources;
  for (unsigned int w = 0; w < wells.size(); ++w)
    if (wells[w].in_rock && !wells[w].pressure_control)
    {
      SourceInRock source{w + 1,
                          {},
                          wells[w].fraction,
                          wells[w].perforations[0].source->borehole_radius(),
                          wells[w].value,
                          wells[w].minimum_pressure};
      for (const Perforation &perforation : wells[w].perforations)
        source.points.push_back(perforation.point);
      sources.push_back(source);
    }
  return sources;
}


template <int dim>
std::vector<typename Wells<dim>::SourceSize> Wells<dim>::sources() const
{
  std::vector<SourceSize> result;
  for (const Well &well : wells)
    for (const Perforation &perforation : well.perforations)
      if (perforation.source)
        result.push_back({well.name, perforation.source->source_radius(),
                          perforation.source->borehole_radius() > 0.});
  return result;
}


template <int dim>
void Wells<dim>::save(boost::archive::binary_oarchive &archive) const
{
  for (const SourceSize &source : sources())
    archive << source.radius;
}


template <int dim>
void Wells<dim>::load(boost::archive::binary_iarchive &archive)
{
  has_started = true;
  for (Well &well : wells)
    for (Perforation &perforation : well.perforations)
      if (perforation.source)
      {
        double radius;
        archive >> radius;
        perforation.source->set_source_radius(radius);
      }
}


template <int dim>
double Wells<dim>::next_jump(const double t) const
{
  double next = std::numeric_limits<double>::infinity();
  for (const Well &well : wells)
    next = std::min(next, well.value.next_jump(t));
  return next;
}


template <int dim>
bool Wells<dim>::have_volume() const
{
  return std::any_of(wells.begin(), wells.end(), [](const Well &well) { return well.volume > 0.; });
}


template <int dim>
bool Wells<dim>::are_in_pieces() const
{
  return std::all_of(wells.begin(), wells.end(),
                     [](const Well &well) { return well.value.is_in_pieces(); });
}


template <int dim>
bool Wells<dim>::starts_at(const double t) const
{
  return std::any_of(wells.begin(), wells.end(),
                     [t](const Well &well)
                     { return !well.pressure_control && well.value.rises_from_zero(t); });
}


template class Wells<2>;
template class Wells<3>;
} // namespace stockwork
