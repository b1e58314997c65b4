/** The pages of the documentation, in the order of the navigation. Each is a Markdown file of the repository. */

export interface DocPage {
  /** Path in the repository. */
  readonly source: string;
  /** Name in the folder docs/ of the site. */
  readonly file: string;
  /** In the navigation. The page's own title is its first heading. */
  readonly label: string;
}

export interface PageGroup {
  readonly title: string;
  readonly pages: readonly DocPage[];
}

const page = (source: string, label: string): DocPage => ({ source, file: fileOf(source), label });

export const PAGE_GROUPS: readonly PageGroup[] = [
  {
    title: "Start",
    pages: [
      page("docs/README.md", "Overview"),
      page("docs/install.md", "Install"),
      page("docs/first-plot.md", "Your first plot"),
      page("docs/without-installing.md", "Without installing"),
      page("docs/network.md", "Phone and network"),
      page("docs/raspberry-pi.md", "Raspberry Pi"),
      page("docs/docker.md", "In a container"),
      page("docs/ports.md", "USB ports by system"),
      page("docs/troubleshooting.md", "Troubleshooting"),
      page("docs/upgrade.md", "Upgrade"),
      page("docs/which-program.md", "Choosing a program"),
    ],
  },
  {
    title: "Coming from",
    pages: [
      page("docs/from-axidraw.md", "AxiDraw, NextDraw software"),
      page("docs/from-saxi.md", "saxi"),
      page("docs/vpype.md", "vpype"),
      page("docs/inkscape.md", "Inkscape"),
      page("docs/p5.md", "p5.js and sketches"),
    ],
  },
  {
    title: "How to",
    pages: [
      page("docs/grbl.md", "Grbl machines"),
      page("docs/sheets.md", "Several drawings, large drawings"),
      page("docs/hand-drawing.md", "Draw by hand"),
      page("docs/recipes.md", "From every tool"),
      page("docs/config-examples.md", "Config files"),
      page("docs/brushless-servo.md", "Brushless servo"),
      page("docs/classroom.md", "Classroom"),
    ],
  },
  {
    title: "Reference",
    pages: [
      page("docs/import.md", "Drawings it reads"),
      page("docs/cli.md", "Command line"),
      page("docs/library.md", "Library guide"),
      page("docs/library-reference.md", "Library reference"),
      page("docs/api.md", "HTTP interface"),
      page("docs/http-reference.md", "HTTP reference"),
    ],
  },
  {
    title: "How it works",
    pages: [
      page("docs/motion.md", "Motion"),
      page("docs/comparison.md", "Planners compared"),
      page("docs/ebb.md", "The board"),
      page("docs/benchmarks.md", "Benchmarks"),
    ],
  },
  {
    title: "Project",
    pages: [
      page("ARCHITECTURE.md", "Architecture"),
      page("CONTRIBUTING.md", "Contributing"),
      page("SECURITY.md", "Security"),
      page("CHANGELOG.md", "Changes"),
      page("LICENSE", "Licence"),
    ],
  },
];

export const PAGES: readonly DocPage[] = PAGE_GROUPS.flatMap(({ pages }) => pages);

/** docs/README.md -> index.html, docs/cli.md -> cli.html, LICENSE -> license.html */
function fileOf(source: string): string {
  const name = source
    .replace(/^docs\//, "")
    .replace(/\.md$/, "")
    .replace(/^README$/, "index");
  return `${name.toLowerCase()}.html`;
}
