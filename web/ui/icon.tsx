/** Line icons on a 20 × 20 grid in the text's colour. Decorative: the button has the label. */
const PATHS = {
  plus: "M10 4v12M4 10h12",
  minus: "M4 10h12",
  fit: "M4 8V4h4M12 4h4v4M16 12v4h-4M8 16H4v-4",
  chevron: "M6 8l4 4 4-4",
  up: "M5 12l5-5 5 5",
  down: "M5 8l5 5 5-5",
  close: "M5 5l10 10M15 5L5 15",
  play: "M7 4.5v11l8.5-5.5z",
  pause: "M7 4.5v11M13 4.5v11",
  again: "M15.5 10a5.5 5.5 0 1 1-1.8-4.1M15.5 3v3.4h-3.4",
  eye: "M2.5 10S5.5 5 10 5s7.5 5 7.5 5-3 5-7.5 5-7.5-5-7.5-5zM10 12a2 2 0 1 0 0-4 2 2 0 0 0 0 4z",
  file: "M5 3h7l3.5 3.5V17H5zM12 3v3.5h3.5",
  folder: "M3 5.500h5l2 2h7v8.500H3z",
  paper: "M4 5.500h12v9H4zM6.500 8h7v4h-7z",
  layers: "M10 3.500l7 3.500-7 3.500L3 7zM3 10l7 3.500L17 10M3 13l7 3.500 7-3.500",
  lines: "M3 14.500c3.500-10 6-10 7-4.500s3.500 5.500 7-4.500",
  speed: "M3.500 14a6.500 6.500 0 1 1 13 0M10 14l3.500-5",
  plotter: "M3 6h14M7 6v9M5 4v4h4V4zM7 15l-1.500-2h3z",
  queue: "M4 5.500h12M4 10h12M4 14.500h7M14 12.500v4l3-2z",
  sun: "M10 13.5a3.5 3.5 0 1 0 0-7 3.5 3.5 0 0 0 0 7zM10 2v2M10 16v2M2 10h2M16 10h2M4.3 4.3l1.4 1.4M14.3 14.3l1.4 1.4M15.7 4.3l-1.4 1.4M5.7 14.3l-1.4 1.4",
  moon: "M16 11.5A6.5 6.5 0 1 1 8.5 4a5 5 0 0 0 7.5 7.5z",
  auto: "M10 3a7 7 0 1 0 0 14zM10 3a7 7 0 0 1 0 14",
  compass: "M10 17a7 7 0 1 0 0-14 7 7 0 0 0 0 14zM10 13.500v-7M7 9.500l3-3 3 3",
  travel: "M3 15l4-9 4 8 5-10",
  stop: "M7 3h6l4 4v6l-4 4H7l-4-4V7zM7.500 7.500l5 5M12.500 7.500l-5 5",
  warning: "M10 3l7.5 13h-15zM10 8.5v3.5M10 14v.5",
  undo: "M7 5L4 8l3 3M4 8h7a4.5 4.5 0 0 1 0 9H8",
  redo: "M13 5l3 3-3 3M16 8H9a4.5 4.5 0 0 0 0 9h3",
  graph: "M3 16.500h14M4 13l3.500-6 3.500 4 2.500-6 2.500 5",
  help: "M7.5 7.5a2.5 2.5 0 1 1 3.6 2.3c-.8.4-1.1.9-1.1 1.7M10 14.3v.4",
  frame: "M4 8V5h3M9 5h2M13 5h3v3M16 9.500v1M16 12v3h-3M11 15H9M7 15H4v-3M4 10.500v-1",
  place: "M5 5h10v10H5zM3.500 3.500h3v3h-3zM13.500 3.500h3v3h-3zM3.500 13.500h3v3h-3zM13.500 13.500h3v3h-3z",
  grip: "M7 5v.01M13 5v.01M7 10v.01M13 10v.01M7 15v.01M13 15v.01",
  share:
    "M6 12.500a2.500 2.500 0 1 0 0-5 2.500 2.500 0 0 0 0 5zM14 7a2.500 2.500 0 1 0 0-5 2.500 2.500 0 0 0 0 5zM14 18a2.500 2.500 0 1 0 0-5 2.500 2.500 0 0 0 0 5zM8.200 8.800l3.600-2.600M8.200 11.200l3.600 2.600",
  more: "M4.5 10v.01M10 10v.01M15.5 10v.01",
  full: "M4 8V4h4M12 4h4v4M16 12v4h-4M8 16H4v-4M8 8L4.500 4.500M12 12l3.500 3.500M12 8l3.500-3.500M8 12l-3.500 3.500",
  search: "M9 14.5a5.5 5.5 0 1 0 0-11 5.5 5.5 0 0 0 0 11zM13 13l3.5 3.5",
  home: "M3.5 9.5L10 4l6.5 5.5M5.5 8.5V16h9V8.5",
} as const;

export type IconName = keyof typeof PATHS;

export const Icon = ({ name }: { name: IconName }) => (
  <svg className="icon" viewBox="0 0 20 20" aria-hidden="true">
    <path d={PATHS[name]} />
  </svg>
);
