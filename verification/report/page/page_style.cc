#include <verification/report/page/page_style.h>

#include <verification/report/pictures/particle_frames.h>
#include <verification/report/plots/gnuplot.h>
#include <verification/report/plots/method_styles.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  namespace
  {
    std::string variables(bool dark)
    {
      std::string list;
      for(std::size_t c = 0; c < palette().size(); ++c)
        list += fmt::format("--series-{}:{};", c,
                            dark ? palette()[c].dark : palette()[c].light);
      if(dark)
        return list
               + "--page:#15181b;--raised:#1c2024;--ink:#e7e9ec;--muted:#a0a8b0;"
                 "--line:#31373d;--accent:#7db8ee;--good:#4fcf8e;--bad:#ff8a7a;--fair:#"
                 "e8b74a;"
                 "--good-area:#16301f;--bad-area:#3a1d1a;--fair-area:#33290f;"
                 "--axis:#8b939b;--grid:#2a2f34;--guide:#6a727a;--solid:#6fb0ee;"
                 "--liquid:#f0a35a;--solid-area:#1f3a55;--liquid-area:#3b2c1c;"
                 "color-scheme:dark;";
      return list
             + fmt::format(
                 "--page:#ffffff;--raised:#f6f7f8;--ink:#1b1f23;--muted:#5c646c;"
                 "--line:#dde1e5;--accent:#0b5fad;--good:#17713f;--bad:#b3261e;--fair:#"
                 "8a5a00;"
                 "--good-area:#e6f4ea;--bad-area:#fce8e6;--fair-area:#fdf3dc;"
                 "--axis:{};--grid:{};--guide:{};--solid:{};--liquid:{};--solid-area:{};"
                 "--liquid-area:{};color-scheme:light;",
                 plot_colours::axis, plot_colours::grid, plot_colours::guide,
                 plot_colours::solid, plot_colours::liquid, plot_colours::solid_area,
                 plot_colours::liquid_area);
    }

    constexpr const char *rules = R"css(
*{box-sizing:border-box}
html{scroll-padding-top:3.4rem;-webkit-text-size-adjust:100%}
body{margin:0;background:var(--page);color:var(--ink);
 font:16px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
main{max-width:1180px;margin:0 auto;padding:0 28px 80px}
a{color:var(--accent);text-decoration-thickness:1px;text-underline-offset:.18em}
h1{font-size:2.1rem;line-height:1.15;letter-spacing:-.018em;margin:.2rem 0 .6rem;font-weight:680}
h2{font-size:1.5rem;line-height:1.2;letter-spacing:-.01em;margin:0 0 .5rem;font-weight:660}
h3{font-size:1.02rem;margin:2.2rem 0 .6rem;font-weight:650}
h1,h2,h3,td,th,dd,li,p{overflow-wrap:break-word}
p{max-width:74ch;margin:.5rem 0 .9rem}
p.lead{font-size:1.06rem;color:var(--muted)}
section{padding-top:2.6rem;margin-top:2.6rem;border-top:1px solid var(--line)}
code,.hash,pre{font-family:ui-monospace,"SF Mono",Menlo,Consolas,"Liberation Mono",monospace;font-size:.86em}
pre{background:var(--raised);padding:14px 16px;border-radius:6px;overflow-x:auto;line-height:1.45}
.definitions{position:absolute}
nav{position:sticky;top:0;z-index:5;background:var(--page);border-bottom:1px solid var(--line)}
nav div{max-width:1180px;margin:0 auto;padding:0 28px;display:flex;gap:1.15rem;overflow-x:auto;
 white-space:nowrap;font-size:.84rem;scrollbar-width:none}
nav div::-webkit-scrollbar{display:none}
nav a{color:var(--muted);text-decoration:none;padding:.62rem 0;border-bottom:2px solid transparent}
nav a:hover{color:var(--ink);border-color:var(--accent)}
nav .mark{color:var(--ink);font-weight:680}
nav .bar{border-left:1px solid var(--line);margin:.6rem 0}
.kicker{color:var(--muted);font-size:.86rem;margin:2.6rem 0 0}
.verdict{display:inline-block;font-size:1.22rem;font-weight:640;padding:.42rem .9rem;border-radius:6px;
 margin:.3rem 0 .8rem}
.good{color:var(--good)} .bad{color:var(--bad)} .fair{color:var(--fair)}
.verdict.good{background:var(--good-area)} .verdict.bad{background:var(--bad-area)}
.verdict.fair{background:var(--fair-area)}
.facts{display:grid;grid-template-columns:repeat(auto-fit,minmax(128px,1fr));gap:1px;background:var(--line);
 border:1px solid var(--line);border-radius:8px;overflow:hidden;margin:1.3rem 0}
.facts div{background:var(--page);padding:.75rem .95rem}
.facts dt{color:var(--muted);font-size:.79rem}
.facts dd{margin:.1rem 0 0;font-size:1.12rem;font-weight:620;font-variant-numeric:tabular-nums}
.badge{display:inline-block;font-size:.8rem;font-weight:620;padding:.06rem .5rem;border-radius:4px;white-space:nowrap}
.badge.good{background:var(--good-area)} .badge.bad{background:var(--bad-area)}
.badge.fair{background:var(--fair-area)}
.badge.none{color:var(--muted);background:var(--raised);font-weight:500}
.scroll{overflow-x:auto;margin:.7rem 0 .4rem}
table{border-collapse:collapse;font-size:.86rem;line-height:1.4;font-variant-numeric:tabular-nums lining-nums}
caption{text-align:left;color:var(--muted);padding:0 0 .4rem;font-size:.86rem}
th,td{padding:.27rem .72rem;text-align:left;vertical-align:baseline}
th:first-child,td:first-child{padding-left:.1rem}
thead th{font-weight:600;vertical-align:bottom;border-bottom:1.5px solid var(--ink);line-height:1.25}
th.number{max-width:9.5em;white-space:normal}
a.case{white-space:nowrap}
thead .options{display:block;font-weight:400;color:var(--muted)}
.share{color:var(--muted);white-space:nowrap}
.unit{display:block;font-weight:400;color:var(--muted);font-size:.93em}
tbody+tbody tr:first-child>*{border-top:1px solid var(--line)}
table:last-child tbody:last-child tr:last-child>*{border-bottom:1px solid var(--line)}
.number{text-align:right;white-space:nowrap}
td sup,td sub,.equation sup,.equation sub{line-height:0;font-size:.76em}
.group th{font-weight:620;padding-top:.7rem;text-align:left}
.group th>span{position:sticky;left:.1rem}
.summary td{border-top:1px dotted var(--line);color:var(--muted);white-space:nowrap}
.summary small{display:block;font-size:.86em;line-height:1.1}
td b{color:var(--ink);font-weight:720}
.plain td{white-space:normal;max-width:46ch}
.plain td.number{white-space:nowrap}
.links{font-size:.83rem;color:var(--muted);margin:.1rem 0 1rem}
.key{display:inline-flex;align-items:center;gap:.45rem;white-space:nowrap}
.key svg{flex:none;overflow:visible}
.key .options{white-space:normal}
.legend{display:flex;flex-wrap:wrap;gap:.3rem 1.4rem;font-size:.87rem;max-width:none}
figure{margin:.9rem 0}
figcaption{color:var(--muted);font-size:.84rem;line-height:1.45;max-width:70ch;margin-top:.2rem}
.plot{overflow-x:auto}
.plot svg{display:block;width:100%;height:auto;max-width:720px;color:var(--ink);
 font-family:system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
.plot text{stroke:var(--page);stroke-width:3px;stroke-linejoin:round;paint-order:stroke}
.pair h3:first-child{margin-top:.6rem}
.pair{display:grid;grid-template-columns:repeat(2,minmax(0,1fr));gap:1.2rem 2rem;align-items:start}
.multiples{display:grid;grid-template-columns:repeat(auto-fill,minmax(250px,1fr));gap:.6rem 1rem}
.multiples figure{margin:0}
.multiples.wide{grid-template-columns:repeat(auto-fill,minmax(330px,1fr))}
.nothing{color:var(--muted);font-size:.88rem}
.equations{overflow-x:auto;padding:.4rem 0}
.equation{display:flex;align-items:baseline;gap:1rem;margin:.55rem 0 .9rem;white-space:nowrap;
 font-family:"STIX Two Text","Cambria Math",Cambria,Georgia,"Times New Roman",serif;font-size:1.1rem}
.equation .where{font:600 .84rem system-ui,-apple-system,"Segoe UI",sans-serif;color:var(--muted);flex:0 0 3.6rem}
.filled{display:block;margin-top:.3rem;color:var(--muted)}
.fraction{display:inline-flex;flex-direction:column;vertical-align:middle;text-align:center;line-height:1.2;
 font-size:.92em;margin:0 .1em}
.fraction>span:first-child{border-bottom:1px solid currentColor;padding:0 .18em .04em}
.fraction>span:last-child{padding:.06em .18em 0}
.side{font-family:system-ui,sans-serif;font-size:.6em!important;position:relative;top:.5em;color:var(--muted)}
.conditions{display:grid;grid-template-columns:4.6rem 1fr;gap:.2rem 0;font-size:.92rem;margin:.6rem 0}
.conditions dt{color:var(--muted);font-weight:600;font-size:.84rem;padding-top:.1rem}
.conditions dd{margin:0}
details{margin:.5rem 0;font-size:.93rem}
summary{cursor:pointer;color:var(--muted);font-size:.87rem}
summary:hover{color:var(--ink)}
ul,ol{padding-left:1.25rem;max-width:82ch} li{margin:.22rem 0}
.tags{font-size:.84rem;color:var(--muted)}
.hash{overflow-wrap:anywhere}
.off{color:var(--muted)}
@media screen and (max-width:760px){
 body{font-size:15px}
 main,nav div{padding-left:16px;padding-right:16px}
 h1{font-size:1.62rem} h2{font-size:1.28rem}
 .pair{grid-template-columns:minmax(0,1fr)}
 .pair:not(.scene) .plot svg{min-width:460px}
}
@media print{
 .pair{break-inside:avoid}
 nav{display:none} body{font-size:10.5pt} main{max-width:none;padding:0}
 section{margin-top:1.2rem;padding-top:1.2rem}
 figure,tr,.equations,.facts{break-inside:avoid} h2,h3{break-after:avoid}
 .scroll,.plot{overflow:visible} table{font-size:7.6pt} th,td{padding:.15rem .35rem}
 a{color:inherit;text-decoration:none}
}
)css";
    std::string page_style()
    {
      // Paper is light whatever the screen prefers.
      return fmt::format(":root{{{}}}\n@media screen and "
                         "(prefers-color-scheme:dark){{:root{{{}}}}}\n",
                         variables(false), variables(true))
             + rules + frame_style();
    }
  } // namespace

  Markup page_head(const std::string &title)
  {
    return void_element("meta", {{"charset", "utf-8"}})
           + void_element("meta", {{"name", "viewport"},
                                   {"content", "width=device-width, initial-scale=1"}})
           + void_element("meta", {{"name", "color-scheme"}, {"content", "light dark"}})
           + element("title", title) + element("style", Markup(page_style()));
  }
} // namespace meltfront::verification
