declare module 'swagger-ui-dist/swagger-ui-es-bundle.js' {
  /** Shows a description of an API (openapi.yaml) in an element of the page. */
  export default function SwaggerUI(options: {
    url: string;
    dom_id: string;
    deepLinking: boolean;
    filter: boolean;
    defaultModelsExpandDepth: number;
    defaultModelRendering: 'example' | 'model';
    supportedSubmitMethods: readonly string[];
    validatorUrl: string | null;
  }): void;
}
