# The method in two dimensions.
target_sources(meltfront_particles PRIVATE plane_bins.cc plane_bodies.cc plane_bounds.cc plane_closure.cc plane_contour.cc plane_events.cc plane_front.cc
                                           plane_heat.cc plane_marked_front.cc
                                           plane_measure.cc plane_nodes.cc plane_power.cc plane_relax.cc plane_report.cc plane_run.cc plane_sinks.cc
                                           plane_step.cc plane_stencils.cc plane_topology.cc)
meltfront_test(front_tracking_plane_tests tests/plane_pieces_test.cc tests/plane_cases.cc
               LIBS meltfront_test_support meltfront_particles meltfront_exact Eigen3::Eigen)
meltfront_test(front_tracking_plane_run_tests tests/plane_run_test.cc tests/plane_capillarity_test.cc tests/plane_cases.cc
               LIBS meltfront_test_support meltfront_particles meltfront_exact Eigen3::Eigen)
meltfront_test(front_tracking_plane_event_tests tests/plane_events_test.cc tests/plane_cases.cc
               LIBS meltfront_test_support meltfront_particles meltfront_exact Eigen3::Eigen)
meltfront_test(front_tracking_plane_relax_tests tests/plane_relax_test.cc tests/plane_cases.cc
               LIBS meltfront_test_support meltfront_particles meltfront_exact Eigen3::Eigen)
