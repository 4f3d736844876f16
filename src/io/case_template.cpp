// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/case_template.hpp"

namespace perimode {

std::string_view modal_template() {
  return R"(# Modes of a steel plate that is clamped at its left end and has an edge crack.
# Run:    perimode modal this_file.yaml
# Check:  perimode check this_file.yaml      (reads everything, runs nothing)
# All numbers are plain SI: m, kg, s, N, Pa. Every key is described in docs/case_reference.md.
title: clamped steel plate with an edge crack

body:
  dimension: 2                  # 1 bar, 2 plate or slice, 3 solid
  plane: stress                 # 2D: stress (Poisson's ratio 1/3) | strain (1/4); the theory fixes it
  thickness: 0.005              # 2D, m   (in 1D: area, m2)
  particles:
    grid:                       # particles sit at the centres of square cells
      lower: [0, 0]             # m
      upper: [0.4, 0.2]         # the box holds a whole number of cells
      spacing: 0.01             # m; finer: 0.005, 0.0025
    # file: cloud.csv           # instead of grid: columns x,y,volume[,block]
  horizon: { ratio: 3 }         # in spacings | { length: 0.03 } in m | { neighbours: 30 } (clouds)
  # periodic: [y]               # opposite faces are joined
  precracks:                    # bonds that cross these segments are cut
    - { from: [0.2, 0.0], to: [0.2, 0.05] }
  # blocks:                     # parts with a material of their own, see `materials`
  #   inclusion: { ball: { centre: [0.3, 0.1], radius: 0.03 } }

material:
  youngs_modulus: 210.0e+9      # Pa
  density: 7850                 # kg/m3
  micromodulus: { kernel: constant }   # constant | conical | gaussian (with p) | inverse_distance
  calibration: continuum        # continuum | discrete | discrete_cut
  volume_correction: linear     # none | linear | exact (1D)
# materials:
#   inclusion: { youngs_modulus: 70.0e+9, density: 2700 }   # overrides `material` in that block

boundary:
  - { fix: [x, y], at: { face: x-, layers: 3 } }      # the outermost 3 layers at x-
  # - { wall: y-, type: mirror }  # odd | even | mirror | antimirror | zero_layer | surface_nodes (1D)

analysis:
  modal:
    modes: 10                   # the lowest 10, rigid ones counted | range: [0, 5000] in Hz | shift: 1000 in Hz
    solver: auto                # auto | lanczos | chebyshev | inverse | arpack | dense
    certificate: auto           # proof that no mode is missing: auto | inertia | restart | none
    reference: none             # closed_form: compare with exact frequencies where they exist

output:
  directory: out/plate          # modes.csv, modes.exo (ParaView) and summary.json
)";
}

std::string_view static_template() {
  return R"(# A steel plate with a hole, held at its left end and pulled at its right end.
# Run:    perimode static this_file.yaml
# Check:  perimode check this_file.yaml      (reads everything, runs nothing)
# All numbers are plain SI: m, kg, s, N, Pa. Every key is described in docs/case_reference.md.
title: steel plate with a hole under tension

body:
  dimension: 2                  # 1 bar, 2 plate or slice, 3 solid
  plane: stress                 # 2D: stress (Poisson's ratio 1/3) | strain (1/4); the theory fixes it
  thickness: 0.005              # 2D, m   (in 1D: area, m2)
  particles:
    grid:                       # particles sit at the centres of square cells
      lower: [0, 0]             # m
      upper: [0.4, 0.2]         # the box holds a whole number of cells
      spacing: 0.005            # m; finer: 0.0025
      remove: [ { ball: { centre: [0.2, 0.1], radius: 0.03 } } ]
    # file: cloud.csv           # instead of grid: columns x,y,volume[,block]
  horizon: { ratio: 3 }         # in spacings | { length: 0.03 } in m | { neighbours: 30 } (clouds)
  # precracks:                  # bonds that cross these segments are cut
  #   - { from: [0.2, 0.0], to: [0.2, 0.05] }

material:
  youngs_modulus: 210.0e+9      # Pa
  density: 7850                 # kg/m3
  micromodulus: { kernel: constant }   # constant | conical | gaussian (with p) | inverse_distance
  calibration: discrete         # continuum | discrete | discrete_cut
  volume_correction: linear     # none | linear | exact (1D)

boundary:
  - { fix: [x, y], at: { face: x-, layers: 3 } }      # the outermost 3 layers at x-
  # - { prescribe: { x: 1.0e-4 }, at: { face: x+, layers: 3 } }   # a given displacement, m
  # - { wall: y-, type: mirror }  # a symmetry plane; see docs/case_reference.md for the others

analysis:
  static:
    loads:                      # they act in full; several add up
      - { traction: [100.0e+6, 0], at: { face: x+, layers: 3 } }    # Pa, on a face
      # - { body_force: [0, -77.0e+3] }                             # N/m3, of the whole body or `at` a region
      # - { force: [0, -500], at: { nearest: [0.4, 0.1] } }         # N in all, shared by volume
    solver: auto                # auto | cholesky | multigrid | jacobi | lu
    tolerance: 1.0e-8           # of the residual |f - K u| / |f|

output:
  directory: out/plate          # fields.exo (ParaView), reactions.csv and summary.json
  fields: [displacement, strain, stress, energy]    # also: damage
)";
}

std::string_view transient_template() {
  return R"(# A steel plate that is hit at its left edge: a pulse runs through it and out into damping layers.
# Run:    perimode transient this_file.yaml
# Check:  perimode check this_file.yaml      (reads everything, says the stable step, runs nothing)
# All numbers are plain SI: m, kg, s, N, Pa. Every key is described in docs/case_reference.md.
title: steel plate hit at its left edge

body:
  dimension: 2                  # 1 bar, 2 plate or slice, 3 solid
  plane: stress                 # 2D: stress (Poisson's ratio 1/3) | strain (1/4); the theory fixes it
  thickness: 0.005              # 2D, m   (in 1D: area, m2)
  particles:
    grid:                       # particles sit at the centres of square cells
      lower: [0, 0]             # m
      upper: [0.4, 0.2]         # the box holds a whole number of cells
      spacing: 0.0025           # m; a wave wants at least 10 of them
    # file: cloud.csv           # instead of grid: columns x,y,volume[,block] | mesh.msh | mesh.exo
  horizon: { ratio: 3 }         # in spacings | { length: 0.03 } in m | { neighbours: 30 } (clouds)
  # precracks:                  # bonds that cross these segments are cut
  #   - { from: [0.2, 0.0], to: [0.2, 0.05] }

material:
  youngs_modulus: 210.0e+9      # Pa
  density: 7850                 # kg/m3
  micromodulus: { kernel: constant }   # constant | conical | gaussian (with p) | inverse_distance
  calibration: discrete         # continuum | discrete | discrete_cut
  volume_correction: linear     # none | linear | exact (1D)
  # fracture_energy: 135.0      # J/m2: bonds break; or critical_stretch: 1.8e-3

# kinematics: large_rotation    # bonds turn with the body; default: linear

# boundary:
#   - { fix: [x, y], at: { face: x+, layers: 3 } }
#   - { prescribe: { x: 1.0e-5 }, at: { face: x-, layers: 3 }, time: { ramp: 1.0e-5 } }
#   - { wall: y-, type: mirror }  # a symmetry plane; see docs/case_reference.md for the others

analysis:
  transient:
    method: central_difference  # explicit | newmark | hht (implicit) | modal (superposition of modes)
    dt: auto                    # s; auto: 0.9 of the stable step, shortened to hit the end
    end: 1.2e-4                 # s
    # initial:                  # at rest without it: formulas, { file: u0.csv } or { mode: { file, number, scale } }
    #   displacement: ["exp(-1.0e+4*(x-0.2)^2)*1.0e-6", 0]
    loads:                      # time: constant | ramp | step | half_sine | ricker | gaussian | table | expression
      - { traction: [1.0e+6, 0], at: { face: x-, layers: 1 }, time: { ricker: 1.0e+5 } }   # Pa; Hz
    sponge:                     # outgoing waves die in layers at these faces
      faces: [x+, y-, y+]
      width: 0.04               # m; at least half a wave
    # damping: { rayleigh: [100, 1.0e-9] }    # C = 100 M + 1e-9 K
    probes:                     # columns of history.csv, beside the energies
      middle: { displacement_at: [0.2, 0.1] }
      edge: { velocity_at: [0.0, 0.1] }
      gauge: { strain_between: [[0.29, 0.1], [0.31, 0.1]] }
    history_every: 1            # steps
    fields_every: 20            # steps | fields_at: [4.0e-5, 8.0e-5] in s
    # checkpoint_every: 1000    # steps; go on with: perimode transient this_file.yaml --resume

output:
  directory: out/plate          # history.csv, fields.exo (ParaView) and summary.json
  fields: [displacement, energy]    # also: velocity, damage, strain, stress
)";
}

std::string_view quasistatic_template() {
  return R"(# A glass plate with an edge crack, pulled apart: the load at which every bond breaks, until it is in two.
# Run:    perimode quasistatic this_file.yaml
# Check:  perimode check this_file.yaml      (reads everything, runs nothing)
# All numbers are plain SI: m, kg, s, N, Pa. Every key is described in docs/case_reference.md.
title: glass plate with an edge crack, pulled apart

body:
  dimension: 2                  # 1 bar, 2 plate or slice, 3 solid
  plane: stress                 # 2D: stress (Poisson's ratio 1/3) | strain (1/4); the theory fixes it
  thickness: 0.005              # 2D, m   (in 1D: area, m2)
  particles:
    grid:                       # particles sit at the centres of square cells
      lower: [0, 0]             # m
      upper: [0.1, 0.05]        # the box holds a whole number of cells
      spacing: 0.0025           # m; finer: 0.00125
      # remove: [ { ball: { centre: [0.07, 0.03], radius: 0.01 } } ]
    # file: cloud.csv           # instead of grid: columns x,y,volume[,block] | mesh.msh | mesh.exo
  horizon: { ratio: 3 }         # in spacings | { length: 0.03 } in m | { neighbours: 30 } (clouds)
  precracks:                    # bonds that cross these segments are cut
    - { from: [0.05, 0.0], to: [0.05, 0.0125] }

material:
  youngs_modulus: 72.0e+9       # Pa
  density: 2440                 # kg/m3
  micromodulus: { kernel: constant }   # constant | conical | gaussian (with p) | inverse_distance
  calibration: discrete         # continuum | discrete | discrete_cut
  volume_correction: linear     # none | linear | exact (1D)
  fracture_energy: 3.8          # J/m2; or critical_stretch: 1.0e-4

boundary:
  - { fix: [x, y], at: { face: x-, layers: 3 } }      # the outermost 3 layers at x-
  # - { prescribe: { x: 1.0e-5 }, at: { face: x+, layers: 3 } }   # instead of loads: what the load factor scales

analysis:
  quasistatic:
    control: event              # event: every break at its exact load factor
                                # steps: loads follow functions of time through `steps` steps to `end`; within one
                                #   the worst bond breaks at a time, or break_at_once: n | all
    loads:                      # times the load factor
      - { traction: [1.0e+6, 0], at: { face: x+, layers: 3 } }    # Pa, on a face
    # dead_loads: [ { body_force: [0, -24.0e+3] } ]   # in full at every load factor
    no_fail:                    # no bond of these particles breaks
      - { face: x-, layers: 5 }
      - { face: x+, layers: 5 }
    stop:                       # whichever comes first
      separated: true           # once a piece that carries load has lost its support
      # events: 1000
      # load_drop: 0.9          # once the load has fallen by 90 % of its peak
    loose: hold                 # pieces left without support: hold | remove
    griffith: true              # also the load at which the crack grows by Griffith's criterion
    solver: auto                # auto | update | stale | refactor | iterate
    fields_every: 100           # events
    # checkpoint_every: 1000    # events; go on with: perimode quasistatic this_file.yaml --resume

output:
  directory: out/plate          # load_curve.csv, crack_path.csv, fields.exo (ParaView) and summary.json
  fields: [displacement, damage]    # also: strain, stress, energy
)";
}

std::string_view dispersion_template() {
  return R"(# How fast and how wrongly waves travel on a glass plate's lattice, and a micromodulus that does better.
# Run:    perimode dispersion this_file.yaml
# Check:  perimode check this_file.yaml      (reads everything, runs nothing)
# All numbers are plain SI: m, kg, s, N, Pa. Every key is described in docs/case_reference.md.
title: waves on a glass plate

body:
  dimension: 2                  # 1 bar, 2 plate or slice, 3 solid
  plane: strain                 # 2D: stress (Poisson's ratio 1/3) | strain (1/4); the theory fixes it
  thickness: 0.005              # 2D, m   (in 1D: area, m2)
  particles:
    grid:                       # waves are those of its endless lattice: the spacing counts, the box does not
      lower: [0, 0]             # m
      upper: [0.1, 0.05]
      spacing: 0.00025          # m
  horizon: { ratio: 3 }         # in spacings | { length: 7.5e-4 } in m

material:
  youngs_modulus: 72.0e+9       # Pa
  density: 2440                 # kg/m3
  micromodulus: { kernel: constant }   # constant | conical | gaussian (with p) | inverse_distance | shells | fourier
  calibration: continuum        # continuum | discrete | discrete_cut
  volume_correction: none       # none | linear | exact (1D); optimise needs none
  fracture_energy: 135.0        # J/m2

analysis:
  dispersion:
    # path: [[0, 0], [1, 0], [1, 1], [0, 0]]   # in pi/spacing; the contour of the irreducible zone without it
    points: 300                 # along the path
    # zone: 101                 # points per axis of the zone's survey; writes zone.csv (1D, 2D)
    # time_step: 2.0e-8         # s; what an integrator makes of the waves
    # integrator: central_difference    # | newmark
    phase_error: 0.05           # up to where phase speeds are right to 5 %: bands.csv
    polar: { wave_number: 0.5, directions: 360 }   # all directions at |k| = 0.5 pi/spacing: polar.csv
    # spectrum: { run: out/pulse }      # also the ridges of a periodic transient run
    optimise:                   # coefficients of the orbits that make waves classical: coefficients.csv
      method: least_squares     # 1D also: point_collocation | subdomain_collocation | galerkin
      norm: l2                  # l2 | l1
      domain: contour           # contour | zone
      lower_bound: none         # of every coefficient; 0: no negative ones
      # poissons_ratio: theory  # another: long-wave speeds right along the axes alone
      # weights: [1, 1]         # of the errors of P and S
      fit: 4                    # cosines of an influence function: influence.yaml

output:
  directory: out/waves          # dispersion.csv, bands.csv and summary.json
)";
}

}  // namespace perimode
