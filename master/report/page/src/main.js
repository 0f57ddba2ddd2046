import uPlot from "uplot";
import "@dagrejs/dagre";
document.getElementById("loading").textContent = `This page cannot show anything yet (${typeof uPlot}).`;
