// The parts of CodeMirror that the page uses. `npm ci && npm run build` in this folder bundles them as codemirror.js.
import {defaultKeymap, history, historyKeymap, indentWithTab} from "@codemirror/commands";
import {bracketMatching, indentUnit} from "@codemirror/language";
import {lintGutter} from "@codemirror/lint";
import {highlightSelectionMatches, searchKeymap} from "@codemirror/search";
import {EditorState} from "@codemirror/state";
import {EditorView, drawSelection, highlightActiveLine, keymap, lineNumbers} from "@codemirror/view";

export {HighlightStyle, StreamLanguage, syntaxHighlighting} from "@codemirror/language";
export {setDiagnostics} from "@codemirror/lint";
export {tags} from "@lezer/highlight";
export {EditorState, EditorView};

// `keys` have priority.
export const basic = keys => [
  lineNumbers(), lintGutter(), history(), drawSelection(), highlightActiveLine(), bracketMatching(), highlightSelectionMatches(),
  indentUnit.of("    "), EditorState.tabSize.of(4),
  keymap.of([...keys, indentWithTab, ...defaultKeymap, ...historyKeymap, ...searchKeymap])];
