// SPDX-License-Identifier: MIT
// Formulas as effect files spell them, "dz/dt = (qd - abs(qd)*z)/zs", typeset as MathML.
import { element, math } from "./dom.js";

const kGreek = {
  alpha: "\u03b1", beta: "\u03b2", gamma: "\u03b3", delta: "\u03b4", eta: "\u03b7", theta: "\u03b8",
  kappa: "\u03ba", lambda: "\u03bb", mu: "\u03bc", nu: "\u03bd", rho: "\u03c1", sigma: "\u03c3",
  tau: "\u03c4", phi: "\u03c6", omega: "\u03c9", pi: "\u03c0", torque: "\u03c4",
};

class Syntax extends Error {}

function tokens(text) {
  const found = text.match(/\d+\.?\d*(?:e[-+]?\d+)?|[A-Za-z_][A-Za-z_0-9]*|<=|>=|[-+*/^(),=]|\S/g) ?? [];
  return [...found, null];
}

/** A tree of [kind, ...operands] by the grammar of effect files. */
class Reader {
  constructor(text) {
    this.tokens = tokens(text);
    this.place = 0;
  }
  get next() { return this.tokens[this.place]; }
  take(token) {
    if (this.next !== token) return false;
    ++this.place;
    return true;
  }
  expect(token) {
    if (!this.take(token)) throw new Syntax(`expected ${token}`);
  }
  line() {
    const parts = [this.relation()];
    while (this.take(",")) parts.push(this.relation());
    if (this.next !== null) throw new Syntax(`found ${this.next}`);
    return ["list", ...parts];
  }
  relation() {
    const parts = [this.sum()];
    while (["=", "<=", ">="].includes(this.next)) {
      parts.push(this.tokens[this.place++], this.sum());
    }
    return ["relation", ...parts];
  }
  sum() {
    let left = this.take("-") ? ["negate", this.product()] : this.product();
    while (this.next === "+" || this.next === "-") {
      left = [this.tokens[this.place++] === "+" ? "plus" : "minus", left, this.product()];
    }
    return left;
  }
  product() {
    let left = this.power();
    while (this.next === "*" || this.next === "/") {
      left = [this.tokens[this.place++] === "*" ? "times" : "over", left, this.power()];
    }
    return left;
  }
  power() {
    if (this.take("-")) return ["negate", this.power()];
    const base = this.atom();
    return this.take("^") ? ["power", base, this.power()] : base;
  }
  atom() {
    if (this.take("(")) {
      const inner = this.sum();
      this.expect(")");
      return inner;
    }
    const token = this.next;
    if (token === null || !/^[A-Za-z_0-9]/.test(token)) throw new Syntax(`found ${token}`);
    ++this.place;
    if (/^\d/.test(token)) return ["number", token];
    if (!this.take("(")) return ["name", token];
    const operands = [this.sum()];
    while (this.take(",")) operands.push(this.sum());
    this.expect(")");
    return ["call", token, ...operands];
  }
}

const row = (...children) => math("mrow", {}, children);
const operator = (text, attributes = {}) => math("mo", { text, ...attributes });
/** Parentheses, which grow around fractions and powers alone. */
const fenced = (node, tree) => {
  const stretchy = String(tall(tree));
  return row(operator("(", { stretchy }), node, operator(")", { stretchy }));
};
const tall = (tree) => Array.isArray(tree) && (["over", "power"].includes(tree[0]) || tree.slice(1).some(tall));
const times = () => operator("\u2062", { lspace: "0.1em", rspace: "0.1em" });

function word(text) {
  if (kGreek[text]) return math("mi", { text: kGreek[text] });
  return math("mi", text.length > 1 ? { text, mathvariant: "normal" } : { text });
}

/** qd is q with a dot; Fs and vs are a letter with an index; tau_load has a word as index. */
function nameNode(name) {
  const [first, ...rest] = name.split("_");
  const index = rest.join(" ");
  let base;
  const dots = /^q(d{1,2})$/.exec(first);
  if (dots) {
    base = math("mover", { accent: "true" }, math("mi", { text: "q" }),
      operator(dots[1].length === 1 ? "\u02d9" : "\u00a8"));
  } else if (/^[A-Za-z][a-z0-9]$/.test(first) && !kGreek[first]) {
    base = math("msub", {}, math("mi", { text: first[0] }), math("mi", { text: first.slice(1), mathvariant: "normal" }));
  } else {
    base = word(first);
  }
  return index === "" ? base : math("msub", {}, base, math("mtext", { text: index }));
}

const kRank = { plus: 1, minus: 1, negate: 1, times: 2, over: 3, power: 3 };
/** What stands in a product or under an exponent and binds less tightly gets parentheses. */
function within(tree, rank) {
  const node = nodeOf(tree);
  return (kRank[tree[0]] ?? 4) < rank ? fenced(node, tree) : node;
}

/** dz/dt */
function rateNode(state) {
  const d = () => math("mi", { text: "d", mathvariant: "normal" });
  return math("mfrac", {}, row(d(), nameNode(state)), row(d(), math("mi", { text: "t" })));
}

function callNode(name, operands) {
  const inner = operands.map(nodeOf);
  if (name === "sqrt") return math("msqrt", {}, inner[0]);
  if (name === "exp" && !tall(operands[0])) return math("msup", {}, math("mi", { text: "e", mathvariant: "normal" }), inner[0]);
  const bar = () => operator("|", { stretchy: String(tall(operands[0])), lspace: "0.05em", rspace: "0.05em" });
  if (name === "abs") return row(bar(), inner[0], bar());
  const list = inner.flatMap((node, i) => (i === 0 ? [node] : [operator(","), node]));
  return row(math("mi", { text: name === "sign" ? "sgn" : name, mathvariant: "normal" }),
    operator("\u2061"), fenced(row(...list), ["list", ...operands]));
}

function nodeOf(tree) {
  const [kind, a, b] = tree;
  switch (kind) {
    case "number": return math("mn", { text: a });
    case "name": return nameNode(a);
    case "plus": return row(nodeOf(a), operator("+"), nodeOf(b));
    case "minus": return row(nodeOf(a), operator("\u2212"), within(b, 2));
    case "negate": return row(operator("\u2212"), within(a, 2));
    case "times": return row(within(a, 2), times(), within(b, 2));
    case "over":
      if (b[1] === "dt" && a[0] === "name" && a[1].startsWith("d")) return rateNode(a[1].slice(1));
      return math("mfrac", {}, nodeOf(a), nodeOf(b));
    case "power": {
      const plain = a[0] === "name" || a[0] === "number" || (a[0] === "call" && a[1] === "abs");
      return math("msup", {}, plain ? nodeOf(a) : fenced(nodeOf(a), a), nodeOf(b));
    }
    case "call": return callNode(a, tree.slice(2));
    default: return relationNode(tree);
  }
}

function relationNode([, ...parts]) {
  const signs = { "=": "=", "<=": "\u2264", ">=": "\u2265" };
  return row(...parts.map((part) => (typeof part === "string" ? operator(signs[part]) : nodeOf(part))));
}

/** Lines of formulas; what cannot be read stays the text that it is. */
export function formulaBlock({ lines }) {
  const block = element("div", { class: "formula" });
  for (const line of lines) {
    try {
      const [, ...parts] = new Reader(line).line();
      const nodes = parts.flatMap((part, i) => i === 0 ? [relationNode(part)] :
        [operator(","), math("mspace", { width: "1em" }), relationNode(part)]);
      block.append(element("p", { title: line },
        math("math", { display: "block" }, row(...nodes))));
    } catch (error) {
      if (!(error instanceof Syntax)) throw error;
      block.append(element("p", {}, element("code", { text: line })));
    }
  }
  return block;
}
