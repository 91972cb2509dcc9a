#pragma once

#include "fracture/peridynamics/crossing_bonds.h"
#include "fracture/peridynamics/explicit_bonds.h"
#include "fracture/peridynamics/fracture.h"
#include "fracture/peridynamics/lattice.h"
#include "fracture/peridynamics/new_paths.h"
#include "fracture/peridynamics/pressure_in_bonds.h"
#include "fracture/peridynamics/published_load.h"
#include "fracture/peridynamics/row_versions.h"
#include "fracture/peridynamics/softening_bonds.h"
#include "fracture/peridynamics/tips.h"
#include "fracture/peridynamics/tracked_paths.h"
#include "stockwork/fracture/model.h"

#include <functional>
#include <optional>

namespace stockwork::peridynamics
{
/// Rock made of bonds between the vertices of uniform cells, in a zone around the cracks; finite
/// elements everywhere else. After Sun et al. (2021), with the changes that README.md lists.
template <int dim>
class Peridynamics : public FractureModel<dim>, private KeptTerms
{
public:
  using typename FractureModel<dim>::CellIterator;

  Peridynamics(const Parameters<dim> &parameters, const Scene<dim> &scene);

  Requirements requirements() const override;

  void setup(const MeshView<dim> &mesh_view, const Collectives &collectives) override;

  void begin_step(const StepContext &context) override;

  dealii::ArrayView<const Segment<dim>> segments() const override;

  CellRole<dim> role(const CellIterator &cell) const override;

  const KeptTerms *kept_terms() const override
  {
    return parameters.explicit_steps ? nullptr : this;
  }

  ExplicitRock *explicit_rock() override
  {
    return explicit_bonds.get();
  }

  void assemble(const StepContext &context, const State &state, Sink &sink) const override;

  bool uses_secants() const override
  {
    return softening_bonds.uses_secants();
  }

  std::vector<ExtraUnknown> extra_unknowns() const override;

  Verdict
  advance(const StepContext &context, const State &state, const Collectives &collectives) override;

  bool commit(const StepContext &context, const State &state) override;

  void rollback() override;

  std::vector<std::string> take_messages() override;
  std::map<std::string, std::string> reasons() const override
  {
    return parameters.reasons;
  }

  void wanted_cell_size(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                        std::vector<float> &sizes) const override;

  void save(boost::archive::binary_oarchive &archive) const override;

  void load(boost::archive::binary_iarchive &archive) override;

  FractureSummary summary(const State &state, const Collectives &collectives) const override;

  void write_fields(const State &state, FieldSink<dim> &sink) const override;

private:
  // Bonds that hold.
  unsigned int version() const override
  {
    return row_versions.current();
  }
  bool is_symmetric() const override
  {
    return false;
  }
  std::optional<std::vector<dealii::types::global_dof_index>>
  changed_rows(unsigned int since) const override;
  void add_couplings(const Coupling &couple) const override;
  void
  assemble(const StepContext &context, const dealii::IndexSet &rows, Sink &sink) const override;

  /// No rock is elements. Sites are mass points then (Silling and Askari 2005), as by explicit
  /// steps. Beside elements the mass is theirs, consistent, or waves would be thrown back where the
  /// two meet: lumped masses make short ones slow (tests/unit/peridynamics_seam_test.cc).
  bool is_all_bonds() const
  {
    return lattice.zone.n_peridynamic_sites() == n_nodes;
  }

  /// Break the bonds that the initial open cracks pass through. Those across cohesive ones hold,
  /// but there is fluid between them from the start.
  void cut_initial_cracks();

  /// With the pressure in the bonds, nothing opens where bonds hold, and the fluid in a cohesive
  /// crack would have no room that its pressure could hang on; so its bonds have softened a little.
  void soften_cohesive_cracks();

  /// The bonds that cross a plane where a crack is.
  void cut_along_plane(const dealii::Point<dim> &origin,
                       const dealii::Tensor<1, dim> &normal,
                       bool is_open,
                       const std::function<bool(const dealii::Point<dim> &crossing)> &is_on_crack);

  /// The surface correction makes up for the bonds that sites have lost, where those that are left
  /// are hardly stretched.
  void correct_faces();

  /// Enlarge the zone ahead of where the rock cracks, if there is less than the margin of it left.
  bool enlarge_zone();

  /// Whether a bond that leads out of the zone may do so no longer after enlarge_zone().
  bool zone_may_include(unsigned int site, unsigned int bond) const;

  /// The fracture cells of initial cracks have the cracks' own normals.
  void set_initial_normals();

  /// Those that are broken, or let fluid in, are committed.
  void keep_bonds();

  /// In a divided zone, what all ranks have, sorted, each once; else what this one has.
  template <class T>
  std::vector<T> of_all_ranks(std::vector<T> mine) const;

  /// Of all ranks.
  std::vector<FractureCell<dim>> fracture_cells() const;

  /// Fracture cells and segments follow the broken bonds. The normal of a cell that tips have
  /// left behind does not change any more.
  void refresh_segments();

  /// With the pressure in the bonds, cells of accepted steps stay: their fluid would be lost.
  void keep_committed_cells();

  /// Find the sites whose rows are not what they were before the segments were refreshed: where
  /// bonds have broken or are whole again, where the surface correction is another, and in porous
  /// rock at the corners of cells that have become fracture cells or turned.
  void find_changed_rows(const std::vector<double> &damage_before,
                         const std::vector<double> &corrected_before,
                         const std::vector<FractureCell<dim>> &cells_before);

  /// What cells do to the bonds around them besides elongating them.
  struct OfCells
  {
    std::vector<double> relief; ///< stretch, see pressure_stretch()
    /// With the pressure in the bonds: of the lattice, by the tractions that the faces have lost.
    std::vector<dealii::SymmetricTensor<2, dim>> strain;
    /// Of state-based sites: forces of their dilatations, see dilatation_forces().
    std::vector<double> dilatation_forces;
  };

  /// A bond that is stretched too far.
  struct Candidate
  {
    double stretch; ///< an intact one of the same energy has it, over the critical one, rounded
    unsigned int site, bond;
  };

  /// Break the most stretched bonds.
  void break_bonds(const std::vector<Candidate> &candidates);

  /// Whether the fluid may get into a cell with this bond.
  bool lets_fluid_in(const SofteningBond &bond) const;

  /// Follow the softening bonds, and let candidates soften.
  /// @return whether unknowns or segments have changed
  bool soften_bonds(const std::vector<double> &displacement,
                    const OfCells &of_cells,
                    const std::vector<Candidate> &candidates);

  /// Whether all bonds take the same energy and are as stiff as others.
  bool is_alike() const
  {
    return lattice.rock_of_bonds.is_uniform() && parameters.cohesive_energy == 1.;
  }

  /// Energy that a bond takes, over that of one in the rock outside of regions: of the rock where
  /// it crosses a path, or at its middle.
  double relative_energy(unsigned int site, unsigned int bond) const;

  /// By this much a bond's critical stretch differs from that of one in the rock outside of
  /// regions.
  double relative_stretch(unsigned int site, unsigned int bond) const;

  /// Stretch, of a bond of the lattice's stiffness in the rock outside of regions that has as much
  /// of the energy that it takes.
  double equivalent_stretch(unsigned int site, unsigned int bond, double elongation) const;

  void assemble_softening(const State &state, Sink &sink) const;

  /// With them: what is left of a bond, 1 - D, is what counts of it in dilatations, and what these
  /// do to its ends. See soft_dilatation.cc.
  void assemble_soft_dilatation(const State &state, Sink &sink) const;

  struct SoftSite;
  struct SoftBond;
  std::map<unsigned int, SoftSite>
  soft_sites(const State &state, const std::vector<dealii::SymmetricTensor<2, dim>> &strain) const;
  SoftBond soft_bond(unsigned int number,
                     const std::map<unsigned int, SoftSite> &sites,
                     const State &state,
                     const std::vector<dealii::SymmetricTensor<2, dim>> &strain) const;
  void assemble_on_family(const SoftSite &site, const State &state, Sink &sink) const;
  void assemble_on_ends(unsigned int number, const State &state, Sink &sink) const;
  /// The rows of both unknowns of a bond.
  void
  assemble_law(unsigned int number, const SoftBond &bond, const State &state, Sink &sink) const;

  // With tracked paths (tracking.cc).

  /// Find the bonds that cross paths, if these are others than before.
  void find_crossing_bonds();

  /// Fracture cells and segments are the pieces of paths that fluid has reached.
  void follow_paths();

  /// Say of tips that have come to a side of the domain in this step.
  void tell_of_boundary();

  /// Paths begin where bonds far from all others are stretched too far.
  /// @return why the run cannot go on; empty: it can
  std::string begin_paths(const StepContext &context, const State &state, const OfCells &of_cells);

  /// Paths go on ahead of tips that have come near to their ends.
  void track(const State &state, const OfCells &of_cells);

  /// Of softening bonds, what has become of their elongation without any force, by the unknown.
  /// @param first of these unknowns
  std::map<BondView, double> lost_elongations(const State &state, unsigned int first) const;

  /// Of state-based sites: the force by their dilatation on bonds, over the dilatation per
  /// elongation of these [N m].
  /// @param strain see OfCells
  std::vector<double>
  dilatation_forces(const State &state,
                    const std::vector<dealii::SymmetricTensor<2, dim>> &strain) const;

  /// Of a peridynamic site, but for what it is in situ [Pa].
  /// @param lost elongation of bonds [m]
  dealii::SymmetricTensor<2, dim> stress_of_bonds(unsigned int site,
                                                  const std::map<BondView, double> &lost,
                                                  const OfCells &of_cells) const;

  /// Of a site among elements of the size of the lattice's cells; nothing at the rim of these.
  std::optional<dealii::SymmetricTensor<2, dim>> stress_of_elements(unsigned int site) const;

  /// The stress, with that in situ, in the mean over the sites no farther than @p reach from a
  /// place, weighted by where they are from there [Pa].
  dealii::SymmetricTensor<2, dim>
  mean_stress(const dealii::Point<dim> &place,
              double reach,
              const std::function<double(const dealii::Tensor<1, dim> &away)> &weight,
              const State &state,
              const OfCells &of_cells) const;

  /// The stress ahead of a tip, of sites on the side that @p ahead points to, weighted by their
  /// distance [Pa].
  dealii::SymmetricTensor<2, dim> stress_ahead(const dealii::Point<dim> &tip,
                                               const dealii::Tensor<1, dim> &ahead,
                                               const State &state,
                                               const OfCells &of_cells) const;

  /// What fracture cells conduct along the fracture, in the elements of the pore pressure.
  void assemble_tensor_fluid(const StepContext &context, const State &state, Sink &sink) const;

  /// What the closure as published does otherwise in porous rock.
  void assemble_published_closure(const StepContext &context, const State &state, Sink &sink) const;

  /// The softening bonds as they are committed.
  void restore_softening();

  /// Where bonds that are stretched too far lead out of the zone, and so cannot break.
  enum class Rim
  {
    away,  ///< nowhere
    grows, ///< where it will be enlarged
    stays
  };

  /// The most stretched first.
  std::vector<Candidate>
  overstretched(const std::vector<double> &displacement, const OfCells &of_cells, Rim &rim) const;

  /// What counts in the dilatations of a bond's ends besides displacements: what the same stress
  /// strains the lattice by.
  /// @param added see added_stretch()
  double added_dilatation(unsigned int site,
                          unsigned int bond,
                          double added,
                          const OfCells &of_cells) const;

  /// Of a bond and what is added to its stretch and to its ends' dilatations, the stretch that
  /// counts for softening and breaking, as of a bond of the lattice's stiffness in the rock outside
  /// of regions.
  double stretch_that_counts(unsigned int site,
                             unsigned int bond,
                             double added,
                             double dilated,
                             const std::vector<double> &displacement,
                             const OfCells &of_cells) const;

  /// What counts for softening and breaking besides a bond's elongation: in-situ stress and fluid.
  /// @param of_cells see pressure_stretch()
  double added_stretch(unsigned int site, unsigned int bond, const OfCells &of_cells) const;

  /// The same of a bond that softens.
  double added_stretch(const SofteningBond &bond, const OfCells &of_cells) const;

  /// With the pressure in the bonds, its strain(). Else, of each fracture cell, the stretch
  /// that bonds ahead of it are relieved of: by the in-situ stress normal to the fracture, which
  /// its faces release; and by the fluid. For a cell that fluid enters is open already, by its
  /// rock's stretch w_0 / h. The fluid fills this volume, but its work, p w_0 per area, does not
  /// reach the rock; so that it is not lost, the bonds take so much less to break. What pressure
  /// the pores carry, the rock has seen already.
  OfCells pressure_stretch(const State &state, const Collectives &collectives) const;

  /// That of the nearest cell whose plane crosses a bond, if one is within a horizon.
  double relief_at(unsigned int site, unsigned int bond, const std::vector<double> &relief) const;

  /// See FractureSummary.
  std::string cost() const;

  /// What bonds hold yet across cohesive cracks along which there are paths, as a length [m].
  double length_that_holds() const;

  void write_bonds(FieldSink<dim> &sink) const;

  // By explicit steps (explicit_steps.cc).

  /// @throws InputError where not all of the rock is bonds
  void make_explicit_bonds();

  /// The fracture is what bonds have become.
  /// @return whether segments are others than before
  bool follow_explicit_bonds(const State &state, const Collectives &collectives);

  /// Bonds are what they have become.
  /// @return whether others are broken, or let fluid in, than before
  bool take_explicit_changes(const Collectives &collectives);

  /// Apertures are what broken bonds enclose.
  void open_explicit_bonds(const Collectives &collectives);

  /// Where what is given opens a crack on a path and slides it as well: bonds across it that are
  /// pressed by that do not break, and hold what has parted. A sentence once that counts.
  std::string why_sliding_crack_holds() const;

  /// By bonds that have softened since the step began [J; J/m in 2-D].
  double softened_in_step() const;

  /// Once, when the net pressure is so high that bonds may break where no crack is.
  void warn_of_pressure(const State &state);

  /// Whether a converged solution, in which no more bonds break, can be one.
  Verdict
  verdict_on(const StepContext &context, const State &state, const Collectives &collectives) const;

  /// Volume between the faces [m^2; m^3 in 3-D].
  double fracture_volume(const State &state, const Collectives &collectives) const;

  /// Greatest edge of the box that the fractures fill, or the length of tracked paths [m].
  double extent() const;

  /// A sentence: which zone to write into the deck.
  std::string wanted_zone() const;

  /// The end of a sentence on bonds that break where they should not.
  std::string what_bonds_carry() const;

  /// Of the bonds under displacements of all sites [J/m]: half of that of a bond belongs to each of
  /// its ends, and counts if the end is peridynamic.
  double strain_energy(const std::vector<double> &u) const;

  /// What else is in the momentum rows of a site with state-based bonds: the dilatations of its
  /// family, which act on all within two horizons. By rows, so that each entry of the matrix is
  /// added to once.
  /// @param stiffness per site, nil before and after
  void assemble_dilatations(unsigned int site,
                            std::vector<dealii::Tensor<2, dim>> &stiffness,
                            LocalSystem &local,
                            Sink &sink) const;

  /// Whether this rank assembles the momentum rows of a site as bonds'.
  bool has_rows(unsigned int site) const
  {
    return lattice.zone.sites()[site].peridynamic && lattice.zone.sites()[site].owner == rank;
  }

  const Parameters<dim> parameters;
  const Scene<dim> &scene;
  ZoneShape<dim> shape;
  Lattice<dim> lattice;
  std::optional<Collectives> ranks; ///< null: before setup()
  unsigned int rank = 0;
  unsigned int n_nodes = 0; ///< of the mesh

  BondSet<dim> cracked; ///< broken ones and those that have begun to soften
  SofteningBonds<dim> softening_bonds;
  std::vector<unsigned int> n_broken; ///< bonds of all sites
  Fracture<dim> fracture;
  std::vector<PublishedLoad<dim>> published; ///< of owned segments
  TrackedPaths paths, committed_paths;
  NewPaths<dim> new_paths;
  CrossingBonds<dim> crossing_bonds;
  Tips<dim> tips;
  PressureInBonds<dim> pressure_in_bonds;
  std::map<unsigned int, dealii::Tensor<1, dim>> normals; ///< by active cell index, in porous rock
  std::vector<std::string> messages;
  RowVersions row_versions;                           ///< by whole bonds and cells' normals
  std::unique_ptr<ExplicitBonds<dim>> explicit_bonds; ///< null: steps are not explicit
  double energy_before_explicit = 0.;                 ///< dissipated before they were made [J/m]

  // Committed.
  std::vector<BondPlaces<dim>> committed_bonds, committed_cracked;
  std::map<Place<dim>, std::vector<double>> committed_normals;
  std::vector<std::pair<Place<dim>, std::vector<double>>> committed_cells; ///< and their normals
  std::map<Place<dim>, double> committed_correction; ///< damage of sites that is made up for
  double committed_energy = 0.;
  bool started = false; ///< the initial cracks are cut
  bool told_of_rim = false, told_of_pressure = false, told_of_contact = false;

  // Of the current step.
  bool segments_lag = false; ///< other bonds cross paths since they were refreshed
  std::size_t n_messages_before = 0;
  std::size_t n_segments_before = 0, n_tips_before = 0;
  double extent_before = 0.;
  unsigned int passes = 0;
  bool has_rejected = false;       ///< the last attempt
  bool has_let_fluid_back = false; ///< see TrackedPaths
  /// Attempts rejected at the rim of the zone, since a step was taken at once or the fracture grew.
  unsigned int stops_at_rim = 0;
  std::vector<double> displacement; ///< of all sites, at the last call of advance()
  double dissipated = 0.;           ///< since the start [J/m]
  bool told_of_rim_before = false, told_of_pressure_before = false;
  unsigned int told_of_new_paths_before = 0;
};
} // namespace stockwork::peridynamics
