#include <cases/exact/planar_neumann.h>
#include <particles/front_tracking/line_solver.h>
#include <gtest/gtest.h>
#include <cstdio>
using namespace meltfront;
using namespace meltfront::particles::front_tracking;
TEST(Proto, Neumann)
{
  cases::Material m; m.latent_heat=110; m.melting_temperature=430; m.solid.conductivity=2; m.liquid.conductivity=1;
  cases::PlanarNeumann ex(m,500,380);
  double a=ex.lambda();
  auto time_of=[&](double X){return X*X/(4*a*a);};
  double t0=time_of(.06), t1=time_of(.18);
  std::printf("lam %.10f t0 %.7f t1 %.7f\n",a,t0,t1);
  for(int order: {2,3,4}) for(int scheme:{1,2,3})
  for(int n: {40,80,160,320})
  {
    LineProblem p; p.material=m; p.spacing=1./n;
    for(int i=0;i<=n;++i) p.nodes.push_back(double(i)/n);
    p.walls[0]={cases::BoundaryKind::fixed_temperature,[](double){return 500.;},0};
    p.walls[1]={cases::BoundaryKind::fixed_temperature,[&](double t){return ex.temperature(1.,t);},0};
    LineSettings s; s.basis_order=order; s.dilation=order+.6; s.time_order=scheme;
    LineSolver solver(p,s);
    int steps=n/2; double dt=(t1-t0)/steps;
    auto at=[&](double t){LineState st; st.time=t; st.solid_first=false; st.fronts={ex.front(t)}; for(double x:p.nodes) st.temperature.push_back(ex.temperature(x,t)); return st;};
    solver.restart(at(t0));
    for(int k=1;k<scheme;++k) if(t0-k*dt>0) solver.add_older(at(t0-k*dt));
    for(int k=0;k<steps;++k) { auto o=solver.step_to(t0+(k+1)*dt); if(o!=StepOutcome::accepted){std::printf("outcome %d at %d\n",int(o),k);break;} }
    const auto &st=solver.state();
    double e=0; for(int i=0;i<=n;++i) e=std::max(e,std::abs(st.temperature[i]-ex.temperature(p.nodes[i],st.time)));
    std::printf("order %d bdf %d n %d eX %.3e eT %.3e evals/step %.2f\n",order,scheme,n,st.fronts[0]-ex.front(st.time),e,double(solver.counters().evaluations)/steps);
  }
}
