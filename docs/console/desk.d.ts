// The types of the data between the page and the emulator (modern/publication/desk.py), for the checks of tsconfig.json.

interface Window {
  hull1620Bytes?: number;
  hull1620Version?: string;
  hull1620Local?: { worker: string; machine: string };
  /** The name, the address and the description of each place that the search knows. */
  hull1620Places: [string, string, string][];
}

/** The programs and the decks: an offer is its name, its title and the kind of points that it holds. */
type What = "programs" | "decks";
type Offers = Record<What, [string, string, string][]>;
/** The FORMAT code, the first column and the width of a field. */
type Field = [string, number, number];
/** The name, the kind, the first and the last address of a part of core storage. */
type Region = [string, string, number, number];

/** What a program holds of the hull: points, vertices (the first points, or their indices), faces as indices of points. */
interface Picture {
  points: number[][];
  vertices: number | number[];
  faces: number[][];
  /** After the comparison with the other hull: vertices that the program lacks or adds, and faces that only this hull has. */
  missed?: number[];
  extra?: number[];
  wrong?: number[];
}

/** The comparison of a run and its hull with exact arithmetic (modern/publication/verdict.py). */
interface Verdict {
  lines: string[];
  statement?: number;
  says?: string;
  hull?: Picture;
  final?: Picture;
}

/** The answer to a load. */
interface Load {
  refused?: string[];
  program: string;
  listing: [number, string][];
  deck: string[];
  core: { size: number; regions: Region[] };
  touched: [string[], string[]][];
  formats: [string, Field[]][];
}

/** The answer to a slice of a run; the frames of the recorded run leave out pictures that have not changed. */
interface Frame {
  events: [string, string][];
  card: number;
  statement?: number;
  read?: number;
  seconds: number;
  time: string;
  stands: string;
  waits: string;
  fields?: Field[];
  switches?: boolean[];
  breaks?: number[];
  did?: string[];
  picture?: Picture;
  stages?: number;
  wrote?: number[];
  registers?: [string, string];
  repeats?: number;
  ended: boolean;
  messages?: string[];
  next?: string;
  queued?: boolean;
  undone?: { typed: number; punched: number };
}

/** What console.html holds for the desk: the period programs, the commentary and the recorded run. */
interface DeskData {
  period: Record<string, string>;
  commentary: Record<string, [string, number, number, string][]>;
  recorded: { load: Load; frames: Frame[] };
  pace: number;
}
