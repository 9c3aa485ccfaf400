(async () => {
  const seen = { members: [] };
  try {
    const click = (node) => node.dispatchEvent(new MouseEvent("click", { bubbles: true }));
    let copied = null;
    Object.defineProperty(navigator, "clipboard", { value: { writeText: async (text) => { copied = text; } } });
    const ink = () => [...document.querySelectorAll("#maps canvas[data-map]")].map((canvas) => canvas.toDataURL()).join();
    const look = async () => {
      copied = null;
      click(document.getElementById("copy"));
      await Promise.resolve();
      return {
        heading: document.getElementById("heading").textContent,
        math: document.getElementById("math").innerHTML,
        code: document.getElementById("code").textContent, copied, maps: ink(),
      };
    };
    for (const [member, language] of [[3, "hlsl"], [20, "wgsl"], [20, "python"], [29, "glsl"], [29, "latex"], [0, "rust"]]) {
      click(document.querySelector(`circle[data-member="${member}"]`));
      click(document.querySelector(`button[data-language="${language}"]`));
      seen.members.push({ member, language, ...(await look()) });
    }
    click(document.querySelector("path[data-published='0']"));
    seen.published = document.getElementById("heading").textContent;
    const [axis, error] = document.querySelectorAll("#controls select");
    const labels = () => [...document.querySelectorAll("#front-plot text")].map((text) => text.textContent).join("|");
    const before = labels();
    axis.value = 3; axis.dispatchEvent(new Event("change"));
    seen.profile = labels() !== before && labels().includes("rdna3");
    error.value = 1; error.dispatchEvent(new Event("change"));
    seen.maximum = labels().includes("maximum error");
    click(document.querySelector("button[data-sort='max']"));
    seen.sorted = document.querySelector("th[aria-sort]").textContent;
    seen.rows = document.querySelectorAll("#table tbody tr").length;
    seen.check = window.lgpCheck();
    seen.spheres = SPHERES.map(({ member, settings }) => {
      error.value = 0; error.dispatchEvent(new Event("change"));
      click(document.querySelector(`circle[data-member="${member}"]`));
      return window.lgpSpheres(settings, SIZE);
    });
    seen.wide = document.documentElement.scrollWidth - innerWidth;
  } catch (error) {
    seen.failed = String(error.stack ?? error);
  }
  seen.problems = window.problems;
  document.body.dataset.seen = encodeURIComponent(JSON.stringify(seen));
})();
