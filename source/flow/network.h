#pragma once

#include <deal.II/base/array_view.h>
#include <deal.II/base/parameter_handler.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "flow/conductivity.h"
#include "flow/fluid_balance.h"
#include "flow/leak_off.h"
#include "flow/network_segment.h"
#include "flow/wells.h"
#include "stockwork/exchange/collectives.h"
#include "stockwork/exchange/extra_unknown.h"
#include "stockwork/exchange/segment.h"
#include "stockwork/exchange/sink.h"
#include "stockwork/exchange/state.h"

namespace stockwork
{
/// The fluid in fractures, for every fracture model alike: a network of segments, each with one
/// pressure p and an aperture w = B x + w_0 that is a linear functional of the other unknowns.
///
///   A dw/dt + A max(w,0) c_f dp/dt + sum_j T_ij (p_i - p_j) + leak-off = flow from wells,
///
/// with T from the cubic law (conductivity.h; Batchelor 1967) and proppant, and leak-off through
/// both faces (leak_off.h). The fluid loads the rock by A p B^T, the transpose of what the aperture
/// adds to the balance, so that work and volume are conserved. Where the pressure is given,
/// segments have the load only; what they take or give counts as injected or flowing out.
///
/// Where it would take less than the least pressure to fill a segment, that pressure rules there
/// and part of the segment is vapour, which weighs nothing (after Jakobsson, Floberg and Olsson;
/// see Elrod 1981). The fluid then lags behind the tip, and none is lost:
///
///   p >= p_min,  A w >= volume of the fluid,  one of the two is an equality.
///
/// The minimum aperture enters the conductivity only. It should be small beside the aperture near
/// the tip: in viscous fluid, 2 um runs as well as 10 um.
///
/// Everything but the functionals is known on every rank, in the order of the segments' keys.
template <int dim>
class Network
{
public:
  /// Subsections "Fracture flow" and "Wells".
  static void declare_parameters(dealii::ParameterHandler &prm);

  /// @throws InputError
  void parse_parameters(dealii::ParameterHandler &prm);

  /// @param viscosity [Pa s]
  /// @param compressibility c_f [1/Pa]
  /// @param rock_mobility k/mu of the rock, for leak-off that is resolved [m^2/(Pa s)]
  void set_fluid(double viscosity, double compressibility, double rock_mobility);

  /// The same mobility in a region of the rock.
  void set_mobility(const dealii::types::material_id region, const double mobility)
  {
    mobility_of_region[region] = mobility;
  }

  /// What the scene says of pressures.
  /// @param given in all segments [Pa]; NaN: they are solved for
  /// @param in_situ_stress total, tension positive [Pa]: a new segment begins to open at it
  void set_pressures(
    double given,
    std::function<dealii::SymmetricTensor<2, dim>(const dealii::Point<dim> &)> in_situ_stress);

  /// After the fluid.
  /// @param minimum_aperture [m]
  /// @param pressure, aperture, length of a fracture of this scene [Pa, m, m]: of these sizes are
  /// the factors that make all unknowns of the flow pressures and all its equations volumes
  void set_scales(double minimum_aperture, double pressure, double aperture, double length);

  /// The mesh is new; set_segments follows. Collective.
  /// @throws InputError when a perforation opens into rock that does not suit it
  void set_mesh(const MeshView<dim> &mesh, const Scene<dim> &scene, const Collectives &collectives)
  {
    all_wells.set_mesh(mesh, scene, collectives);
  }

  /// Value of an extra unknown as it was before, by key; nothing if it is new.
  using EarlierValue = std::function<std::optional<double>(std::uint64_t key)>;

  /// The fractures or the numbering of the unknowns are new. Collective. Segments that appear
  /// within a step were exposed within it: those of the first of two calls in its first half.
  /// A new pressure starts from that of the nearest neighbour that has one; without any, from that
  /// at which the segment begins to open: the in-situ compression across it, or the pore pressure
  /// in situ where proppant is in it.
  /// @throws InputError when a perforation lies on no fracture
  void set_segments(
    const dealii::ArrayView<const Segment<dim>> &owned,
    const Collectives &,
    const EarlierValue &earlier = [](std::uint64_t) { return std::optional<double>(); });

  /// One pressure for each segment, unless it is given; one pressure drop p_f - p_m for each
  /// segment that leaks into the rock's pores; then those of the wells. The drop could be
  /// eliminated, but that would add to the rock's own matrix, which with it stays as it is.
  std::vector<ExtraUnknown> unknowns() const;

  /// The values of the unknowns before anything was injected: pressures with which segments begin
  /// to open.
  void set_start(std::vector<double> &extra) const;

  /// As if nothing had happened since the start.
  void forget()
  {
    history.clear();
    total = {};
  }

  /// Index of the first of unknowns() among all extra unknowns.
  void set_offset(unsigned int first_index);

  void begin_step(const StepContext &);

  /// Collective.
  void assemble(const StepContext &, const State &, const Collectives &, Sink &) const;

  /// Collective. Of the step, given its unknowns; nothing is committed.
  FluidBalance balance(const StepContext &, const State &, const Collectives &) const;

  /// What rounding leaves: pressures are stored in total, so that in deep rock, or in thin fluid,
  /// the flow that a last digit of them drives is more than a share of what is injected, and a
  /// fracture at the pressure that holds it open by nothing is in balance but for last digits.
  struct Rounding
  {
    double fluid; ///< of the sum of the segments' residuals [m^dim]
    double force; ///< of what presses the faces, fluid or stress in situ [N], [N/m] in 2-D
  };

  /// Collective.
  Rounding rounding(const StepContext &, const State &, const Collectives &) const;

  /// The step is accepted. Collective.
  void commit(const StepContext &, const State &, const Collectives &);

  /// The step is rejected: as if begin_step had not been called. set_segments follows.
  void rollback();

  /// In the order of their keys.
  const std::vector<NetworkSegment<dim>> &segments() const
  {
    return network;
  }

  /// One value per segment. Collective.
  std::vector<double> apertures(const Unknowns &, const Collectives &) const;

  /// Below which the conductivity does not fall [m], an aperture of this scene.
  double smallest_hydraulic_aperture() const
  {
    return minimum_aperture;
  }

  /// One value per segment.
  std::vector<double> pressures(const Unknowns &) const;

  /// Of the segment with this key; zero if there is none. See State::segment_pressure.
  double pressure(std::uint64_t key, const Unknowns &) const;

  /// Index of that pressure among the extra unknowns; nothing where it is given, or no segment.
  std::optional<unsigned int> unknown(std::uint64_t key) const;

  /// What has leaked from each segment up to the last accepted step, through both faces [m^3].
  std::vector<double> leaked_volumes() const;

  /// Collective.
  std::vector<WellReport> wells(const StepContext &, const State &, const Collectives &) const;

  /// Steps should end at this time: the next after t at which a well's rate or pressure jumps.
  double next_jump(double t) const
  {
    return all_wells.next_jump(t);
  }

  /// Whether a well that has rested begins to inject at this time.
  bool starts_at(const double t) const
  {
    return all_wells.starts_at(t);
  }

  /// Whether a well opens into the rock: it needs the pressure of its pores.
  bool opens_into_rock() const
  {
    return all_wells.any_in_rock();
  }

  /// Whether the source of such a well reaches a piece of this size about a place.
  bool sources_reach(const dealii::Point<dim> &place, const double size) const
  {
    return all_wells.sources_reach(place, size);
  }

  /// Whether an extra unknown belongs to such a well.
  bool is_of_rock(const unsigned int index) const
  {
    return all_wells.is_of_rock(index);
  }

  /// Leak-off into pores that are resolved needs their pressure.
  bool needs_pore_pressure() const
  {
    return leak_off == LeakOff::resolved;
  }

  /// Whether what leaks off stays in the model.
  bool leaks_into_pores() const
  {
    return std::any_of(network.begin(), network.end(),
                       [this](const auto &segment) { return leaks_into_pores(segment); });
  }

  LeakOff leak_off_law() const
  {
    return leak_off;
  }

  /// C_L of one face [m/s^(1/2)]
  double carter() const
  {
    return carter_coefficient;
  }

  /// @throws InputError when a perforation lies on no crack of the deck
  void check_perforations(const std::vector<InitialCrack<dim>> &cracks) const
  {
    all_wells.check(cracks);
  }

  /// See Wells::check.
  void check_wells(const double start_time, const double end_time) const
  {
    all_wells.check(start_time, end_time, needs_pore_pressure());
  }

  /// The fluid may lag behind the tips.
  bool may_cavitate() const
  {
    return std::isfinite(vapour_pressure);
  }

  /// Net, of a fracture of this scene [Pa]; see set_scales.
  double typical_pressure() const
  {
    return pressure_scale;
  }

  bool has_wells() const
  {
    return !all_wells.empty();
  }

  /// Of wells that may produce, by name [Pa].
  std::vector<std::pair<std::string, double>> minimum_well_pressures() const
  {
    return all_wells.minimum_pressures();
  }

  /// See Wells.
  double maximum_rate() const
  {
    return all_wells.maximum_rate();
  }

  std::optional<double> maximum_pressure() const
  {
    return all_wells.maximum_pressure();
  }

  unsigned int n_wells() const
  {
    return all_wells.size();
  }

  bool has_borehole_volume() const
  {
    return all_wells.have_volume();
  }

  bool wells_are_in_pieces() const
  {
    return all_wells.are_in_pieces();
  }

  double rate_of_first_well(double t) const
  {
    return all_wells.first_rate(t);
  }

  double fraction_of_first_well() const
  {
    return all_wells.first_fraction();
  }

  std::vector<dealii::Point<dim>> perforations_of_first_well() const
  {
    return all_wells.first_perforations();
  }

  std::vector<typename Wells<dim>::SourceInRock> sources_in_rock() const
  {
    return all_wells.sources_in_rock();
  }

  std::vector<typename Wells<dim>::SourceSize> sources() const
  {
    return all_wells.sources();
  }

  void save(boost::archive::binary_oarchive &) const;

  void load(boost::archive::binary_iarchive &);

private:
  /// What the flow in a step depends on, one value per segment.
  struct Values
  {
    std::vector<double> aperture, aperture_reference;
    std::vector<double> pressure, pressure_reference;
    std::vector<double> pore_pressure;
    std::vector<double> filter_cake_drop; ///< of pressure across the face, for linear leak-off
    std::vector<double> vapour;           ///< volume at the end of the step [m^3]
    std::vector<bool> cavitates;          ///< the pressure is the least, else there is no vapour
    std::vector<double> handed_over;      ///< see History [m^3]
  };

  /// What a segment remembers.
  struct History
  {
    double exposure = 0.; ///< time for which fluid has been at its faces [s]
    double wetted = 0.;   ///< share of it that has fluid at its faces
    double leaked = 0.;   ///< volume through both faces so far [m^3]
    double volume = 0.;   ///< between the faces [m^3]
    double vapour = 0.;   ///< part of it that holds no fluid [m^3]
    /// Room that it got from another segment in the last step; less than nothing: gave to [m^3]
    double handed_over = 0.;
    bool bare = false; ///< the faces have been bare once

    template <class Archive>
    void serialize(Archive &ar, const unsigned int)
    {
      ar &exposure &wetted &leaked &volume &vapour &handed_over &bare;
    }
  };

  /// Index of what is no unknown.
  static constexpr unsigned int no_row = dealii::numbers::invalid_unsigned_int;

  /// Neighbour of a segment, ready for use.
  struct Edge
  {
    unsigned int other;
    double distance;       ///< from this segment's centre to the edge
    double other_distance; ///< from the other's
    double width;          ///< of the edge; at a tip less, see tip_gradient_factor()
  };

  bool pressure_is_given() const
  {
    return !std::isnan(given_pressure);
  }

  /// From which the pressure of a segment starts, see set_segments().
  double initial_pressure(const NetworkSegment<dim> &segment, const EarlierValue &earlier) const;

  /// Of an owned segment [m]; negative where its faces overlap.
  double opening(unsigned int owned_segment, const Unknowns &unknowns) const;

  /// Number of the segment with this key.
  std::optional<unsigned int> number(std::uint64_t key) const;

  Values evaluate(const StepContext &, const State &, const Collectives &) const;

  /// What segments hold from before the step, where some have become segments of their own: these
  /// have what was in their room, and those that the room was part of have so much less. See
  /// Segment::part_of.
  void
  hand_over_room(const StepContext &, const State &, const Collectives &, Values &values) const;

  /// Of the edge to a neighbour: what the apertures conduct, and proppant if both have it.
  Transmissibility
  transmissibility(unsigned int segment, const Edge &edge, const Values &values) const;

  /// Which segments cavitate, and how much vapour there is in them.
  void find_vapour(const StepContext &, Values &) const;

  /// What a segment's row is divided by where it says p = p_min, to be a volume [m^3/Pa].
  double vapour_scale(unsigned int segment) const
  {
    return network[segment].area * minimum_aperture / pressure_scale;
  }

  /// The time of exposure of a segment's faces before and after a step.
  struct Exposure
  {
    double begin, end; ///< [s]
    double slope;      ///< of `end` by the aperture [s/m]
  };
  Exposure exposure(unsigned int segment, const StepContext &, const Values &) const;

  /// Bridges of rock that have once been broken do not hold the faces together again.
  double bare_aperture(const unsigned int segment) const
  {
    const auto old = history.find(network[segment].key);
    return old != history.end() && old->second.bare
             ? minimum_aperture
             : std::max(network[segment].bare_aperture, minimum_aperture);
  }

  /// Whether bridges of rock hold back what leaks from a segment, see Segment::bare_aperture.
  bool bridges_count(const Segment<dim> &segment) const;

  /// Share of the faces of a segment that leaks into pores, as it was at the end of the last step,
  /// so that the law is linear within one.
  double bare_share(unsigned int segment) const;

  /// c_l of the linear leak-off laws [m/(Pa s)].
  double leak_off_coefficient(unsigned int segment) const;

  /// Whether the pressure drop across the faces of a segment is an unknown.
  bool leaks_into_pores(const NetworkSegment<dim> &segment) const
  {
    return segment.rock_has_pore_pressure &&
           (leak_off == LeakOff::filter_cake || leak_off == LeakOff::resolved);
  }

  /// Through both faces, in the step, by its own differences [m^3].
  std::vector<double> leaked_in_step(const StepContext &, const Values &) const;

  void assemble_segment(unsigned int index,
                        const Segment<dim> &,
                        const StepContext &,
                        const Values &,
                        LocalSystem &) const;
  static void keep_part_of_opening(const Segment<dim> &segment, LocalSystem &local);


  struct SegmentRows;
  void add_storage(SegmentRows &) const;
  void add_flow(SegmentRows &) const;
  void add_carter_leak_off(SegmentRows &) const;
  void add_leak_off_by_pressure(SegmentRows &) const;

  double minimum_aperture = std::numeric_limits<double>::quiet_NaN();
  double pressure_scale = std::numeric_limits<double>::quiet_NaN();
  double vapour_pressure = -std::numeric_limits<double>::infinity();
  LeakOff leak_off = LeakOff::none;
  double carter_coefficient = 0.;
  double filter_cake_coefficient = 0.;
  double viscosity = std::numeric_limits<double>::quiet_NaN();
  double compressibility = 0.;
  double rock_mobility = 0.; ///< outside of regions
  std::map<dealii::types::material_id, double> mobility_of_region;
  double given_pressure = std::numeric_limits<double>::quiet_NaN(); ///< in all segments [Pa]
  std::function<dealii::SymmetricTensor<2, dim>(const dealii::Point<dim> &)> in_situ_stress;

  Wells<dim> all_wells;

  std::vector<NetworkSegment<dim>> network; ///< sorted by key
  std::vector<std::vector<Edge>> edges;     ///< of each segment
  std::vector<Segment<dim>> owned;          ///< with their functionals
  std::vector<unsigned int> owned_index;    ///< in `network`
  std::vector<unsigned int> rows;           ///< index of the pressure unknown, or invalid
  std::vector<unsigned int> leak_off_rows;  ///< index of the pressure drop, or invalid

  // committed
  std::map<std::uint64_t, History> history; ///< by key
  FluidVolumes total;

  // trial
  bool in_step = false;
  unsigned int pass = 0;                          ///< of growth within the step
  std::map<std::uint64_t, unsigned int> appeared; ///< key to pass
};
} // namespace stockwork
