import '../styles/pages.css';
import '../styles/editor.css';
import '../styles/rubric.css';

import type { Route } from '../state/route';
import { RubricApi } from '../wire/rubric_api';
import { BenchmarksPage } from './benchmarks_page';
import { RubricPage } from './rubric_page';
import { RubricsPage } from './rubrics_page';

const api = new RubricApi(window.location.origin);

/** The pages about what sessions are scored by, loaded when one of them is first opened. */
export function RubricPages({ route }: { route: Route }) {
  if (route.kind === 'rubric') return <RubricPage key={route.id} api={api} id={route.id} />;
  if (route.kind === 'benchmarks') return <BenchmarksPage api={api} />;
  return <RubricsPage api={api} />;
}
