// Pages for users come before decision records, reports and call traces that have the same word. The other numbers are those of Sphinx.
var Scorer = {
  score: (result) => {
    const [docname, title, anchor, descr, score] = result;
    return /^(adr|benchmarks)\/|^call-traces$/.test(docname) ? score - 4 : score;
  },
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
