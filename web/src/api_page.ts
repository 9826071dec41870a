// The page under /api: the server's own description of its API, to be read. A bundle of its own, so that the page for
// people who ream stays small.
import 'swagger-ui-dist/swagger-ui.css';
import './styles/api_page.css';

import SwaggerUI from 'swagger-ui-dist/swagger-ui-es-bundle.js';

SwaggerUI({
  url: './api/v1/openapi.yaml',
  dom_id: '#api',
  deepLinking: true,
  filter: true,
  defaultModelsExpandDepth: 0,
  defaultModelRendering: 'model',
  // Requests are for programs: a page's own cookie must not change anything from here.
  supportedSubmitMethods: [],
  // Nothing is asked of anybody but this server.
  validatorUrl: null,
});
