// Draws the diagrams of a page in the colours that it has when it is loaded.
{
  const chosen = document.body.dataset.theme;
  const isDark = chosen === "dark" || (chosen !== "light" && matchMedia("(prefers-color-scheme: dark)").matches);
  mermaid.initialize({ startOnLoad: true, theme: isDark ? "dark" : "neutral", securityLevel: "strict" });
}
