import {EditorState, EditorView, HighlightStyle, StreamLanguage, basic, setDiagnostics, syntaxHighlighting, tags}
  from "./codemirror.js";

const $ = id => document.getElementById(id);

const keywords = new Set(("attribute break buffer case const continue default discard do else for if in inout layout out " +
  "precision restrict return shared struct switch uniform while true false").split(" "));
const types = /^(void|bool|int|uint|float|double|[biud]?vec[234]|mat[234](x[234])?)$/;

const language = StreamLanguage.define({
  startState: () => ({inComment: false}),
  token(stream, state) {
    if (state.inComment || stream.match("/*")) {
      state.inComment = !stream.match(/^.*?\*\//);
      if (state.inComment)
        stream.skipToEnd();
      return "comment";
    }
    if (stream.eatSpace())
      return null;
    if (stream.match(/^\/\/.*/))
      return "comment";
    if (stream.sol() && stream.match(/^#\s*\w+/))
      return "meta";
    if (stream.match(/^"(?:[^"\\]|\\.)*"?/))
      return stream.match(/^\s*:/, false) ? "propertyName" : "string";
    if (stream.match(/^(?:0[xX][\da-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)[uUfF]?/))
      return "number";
    const word = stream.match(/^[A-Za-z_]\w*/);
    if (!word) {
      stream.next();
      return null;
    }
    if (keywords.has(word[0]))
      return "keyword";
    if (types.test(word[0]))
      return "typeName";
    if (/^[A-Z][A-Z0-9_]+$/.test(word[0]))
      return "constant";
    return stream.match(/^\s*\(/, false) ? "function" : null;
  },
  tokenTable: {constant: tags.constant(tags.name), function: tags.function(tags.name)},
});

const theme = EditorView.theme({
  "&": {backgroundColor: "var(--ground)", color: "var(--ink)", fontSize: "13px"},
  ".cm-scroller": {fontFamily: "ui-monospace, monospace"},
  ".cm-gutters": {backgroundColor: "var(--ground)", color: "var(--faint)", border: "none"},
  ".cm-activeLine": {backgroundColor: "var(--active-line)"},
  ".cm-cursor": {borderLeftColor: "var(--accent)"},
}, {dark: matchMedia("(prefers-color-scheme: dark)").matches});

const colors = syntaxHighlighting(HighlightStyle.define([
  {tag: tags.comment, color: "var(--comment)", fontStyle: "italic"},
  {tag: tags.keyword, color: "var(--keyword)"},
  {tag: tags.typeName, color: "var(--type)"},
  {tag: tags.number, color: "var(--number)"},
  {tag: tags.string, color: "var(--string)"},
  {tag: tags.propertyName, color: "var(--type)"},
  {tag: tags.meta, color: "var(--meta)"},
  {tag: tags.constant(tags.name), color: "var(--constant)"},
  {tag: tags.function(tags.name), color: "var(--function)"},
]));

export class Editor {
  constructor(names, send) {
    this.names = names;
    this.send = send;
    this.faults = [];
    this.saved = "";
    this.view = new EditorView({parent: $("text"), state: this.stateOf("")});
    $("file").replaceChildren(...names.map(name => new Option(name)));
    const last = decodeURIComponent(location.hash.slice(1));
    $("file").value = [last, "phong.glsl", "pathtrace.comp", names[0]].find(name => this.has(name));
    $("file").addEventListener("change", () => this.choose($("file").value));
    $("keep").addEventListener("click", () => this.keep());
    window.addEventListener("beforeunload", event => {
      if (this.isEdited())
        event.preventDefault();
    });
    this.choose($("file").value);
  }

  has(name) {
    return this.names.includes(name);
  }

  stateOf(text) {
    return EditorState.create({doc: text, extensions: [
      basic([{key: "Mod-s", run: () => this.keep(), preventDefault: true}]), language, theme, colors,
      EditorView.updateListener.of(update => update.docChanged && this.mark())]});
  }

  get text() {
    return this.view.state.doc.toString();
  }

  isEdited() {
    return this.text !== this.saved;
  }

  mark() {
    $("edited").textContent = this.isEdited() ? "not saved" : "";
  }

  choose(name, line) {
    if (this.isEdited() && !confirm(`Leave ${this.name} without saving it?`)) {
      $("file").value = this.name;
      return;
    }
    this.line = line;
    $("file").value = name;
    this.send({open: name});
  }

  judge(course) {
    const {title, verdict, measured} = course ?? {title: "judging ...", verdict: "", measured: ""};
    $("course").hidden = false;
    $("course").firstChild.textContent = verdict ? `${title}: ${verdict}` : title;
    $("course").lastChild.textContent = measured;
  }

  // Another program may have saved the file.
  look(revision) {
    if (this.revision !== undefined && this.revision !== revision && !this.isEdited())
      this.send({open: this.name});
    this.revision = revision;
  }

  open(name, text) {
    if (name === this.name && text === this.text)
      return;
    this.name = name;
    history.replaceState(null, "", `#${encodeURIComponent(name)}`);
    this.saved = text;
    this.view.setState(this.stateOf(text));
    this.mark();
    this.tell(this.faults);
    if (this.line)
      this.show(this.line);
  }

  keep() {
    this.saved = this.text;
    this.send({save: this.name, text: this.text});
    this.mark();
    return true;
  }

  show(line) {
    const at = this.view.state.doc.line(Math.min(Math.max(line, 1), this.view.state.doc.lines));
    this.view.dispatch({selection: {anchor: at.from}, effects: EditorView.scrollIntoView(at.from, {y: "center"})});
    this.line = undefined;
  }

  // Marks the lines of faults, and lists all faults below the text.
  tell(faults) {
    if (this.told !== JSON.stringify([this.name, faults])) {
      this.told = JSON.stringify([this.name, faults]);
      this.faults = faults;
      const doc = this.view.state.doc;
      const here = faults.filter(fault => fault.file === this.name && fault.line >= 1 && fault.line <= doc.lines);
      this.view.dispatch(setDiagnostics(this.view.state, here.map(fault => {
        const {from, to} = doc.line(fault.line);
        return {from, to, severity: "error", message: fault.text};
      })));
      $("faults").replaceChildren(...faults.filter(fault => this.has(fault.file)).map(fault => {
        const item = Object.assign(document.createElement("li"), {textContent: `${fault.file}:${fault.line}: ${fault.text}`});
        item.onclick = () => fault.file === this.name ? this.show(fault.line) : this.choose(fault.file, fault.line);
        return item;
      }));
    }
  }
}
