<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
  <context>
    <name>studio</name>
    <message>
      <source>The app is under the MIT licence. It contains no code of the Inria rasteriser or of CoTracker; models that you connect yourself have licences of their own.</source>
      <translation>Die App steht unter der MIT-Lizenz. Sie enthält keinen Code des Inria-Rasterisierers oder von CoTracker; Modelle, die Sie selbst anschließen, haben eigene Lizenzen.</translation>
    </message>
    <message>
      <source>About and licences</source>
      <translation>Über und Lizenzen</translation>
    </message>
    <message>
      <source>Parts</source>
      <translation>Bestandteile</translation>
    </message>
    <message>
      <source>Marked: frames {a} to {b}. A state or X applies to them.</source>
      <translation>Markiert: Bilder {a} bis {b}. Ein Zustand oder X gilt für sie.</translation>
    </message>
    <message>
      <source>Buttons of this step</source>
      <translation>Knöpfe dieses Schritts</translation>
    </message>
    <message>
      <source>Stride in frames</source>
      <translation>Schrittweite in Bildern</translation>
    </message>
    <message>
      <source>stride</source>
      <translation>Schrittweite</translation>
    </message>
    <message>
      <source>This step is done.</source>
      <translation>Dieser Schritt ist fertig.</translation>
    </message>
    <message>
      <source>Done.</source>
      <translation>Fertig.</translation>
    </message>
    <message>
      <source>Frame with points</source>
      <translation>Bild mit Punkten</translation>
    </message>
    <message>
      <source>Open a clip to begin</source>
      <translation>Öffnen Sie einen Clip, um zu beginnen</translation>
    </message>
    <message>
      <source>What is wrong?</source>
      <translation>Was stimmt nicht?</translation>
    </message>
    <message>
      <source>Swap</source>
      <translation>Tauschen</translation>
    </message>
    <message>
      <source>From this frame on, swap with</source>
      <translation>Ab diesem Bild tauschen mit</translation>
    </message>
    <message>
      <source>Name this moment</source>
      <translation>Diesen Stand benennen</translation>
    </message>
    <message>
      <source>Name</source>
      <translation>Name</translation>
    </message>
    <message>
      <source>Named moments</source>
      <translation>Benannte Stände</translation>
    </message>
    <message>
      <source>Go back to</source>
      <translation>Zurück zu</translation>
    </message>
    <message>
      <source>The second annotator's project</source>
      <translation>Das Projekt der zweiten Person</translation>
    </message>
    <message>
      <source>What both began from (cancel if there is none)</source>
      <translation>Wovon beide ausgingen (abbrechen, wenn es das nicht gibt)</translation>
    </message>
    <message>
      <source>Import tracks</source>
      <translation>Spuren importieren</translation>
    </message>
    <message>
      <source>Export tracks</source>
      <translation>Spuren exportieren</translation>
    </message>
    <message>
      <source>No moment has a name yet (Ctrl+S).</source>
      <translation>Noch kein Stand hat einen Namen (Strg+S).</translation>
    </message>
    <message>
      <source>Named: {name}</source>
      <translation>Benannt: {name}</translation>
    </message>
    <message>
      <source>Back at: </source>
      <translation>Zurück bei: </translation>
    </message>
    <message>
      <source>Exported: {name}</source>
      <translation>Exportiert: {name}</translation>
    </message>
    <message>
      <source>Dope sheet: states of all points over time</source>
      <translation>Zeitübersicht: Zustände aller Punkte</translation>
    </message>
    <message>
      <source>not annotated</source>
      <translation>nicht annotiert</translation>
    </message>
    <message>
      <source>visible</source>
      <translation>sichtbar</translation>
    </message>
    <message>
      <source>occluded</source>
      <translation>verdeckt</translation>
    </message>
    <message>
      <source>out of view</source>
      <translation>außerhalb</translation>
    </message>
    <message>
      <source>No points yet: place them in step 2.</source>
      <translation>Noch keine Punkte: setzen Sie sie in Schritt 2.</translation>
    </message>
    <message>
      <source>frame</source>
      <translation>Bild</translation>
    </message>
    <message>
      <source>key</source>
      <translation>Schlüssel</translation>
    </message>
    <message>
      <source>No more keys that way.</source>
      <translation>In dieser Richtung gibt es keine Schlüssel mehr.</translation>
    </message>
    <message>
      <source>Nothing suspicious is left.</source>
      <translation>Nichts Verdächtiges mehr.</translation>
    </message>
    <message>
      <source>Curve</source>
      <translation>Kurve</translation>
    </message>
    <message>
      <source>Curve over frames</source>
      <translation>Kurve über die Bilder</translation>
    </message>
    <message>
      <source>x</source>
      <translation>x</translation>
    </message>
    <message>
      <source>y</source>
      <translation>y</translation>
    </message>
    <message>
      <source>speed (px per frame)</source>
      <translation>Geschwindigkeit (px je Bild)</translation>
    </message>
    <message>
      <source>acceleration</source>
      <translation>Beschleunigung</translation>
    </message>
    <message>
      <source>confidence</source>
      <translation>Sicherheit</translation>
    </message>
    <message>
      <source>suspicion</source>
      <translation>Verdacht</translation>
    </message>
    <message>
      <source>forward-backward error (px)</source>
      <translation>Hin-und-zurück-Fehler (px)</translation>
    </message>
    <message>
      <source>likeness (NCC)</source>
      <translation>Ähnlichkeit (NCC)</translation>
    </message>
    <message>
      <source>Log and statistics</source>
      <translation>Protokoll und Statistik</translation>
    </message>
    <message>
      <source>Clip</source>
      <translation>Clip</translation>
    </message>
    <message>
      <source>person</source>
      <translation>Person</translation>
    </message>
    <message>
      <source>day</source>
      <translation>Tag</translation>
    </message>
    <message>
      <source>minutes</source>
      <translation>Minuten</translation>
    </message>
    <message>
      <source>edits</source>
      <translation>Änderungen</translation>
    </message>
    <message>
      <source>keys</source>
      <translation>Schlüssel</translation>
    </message>
    <message>
      <source>undone</source>
      <translation>zurückgenommen</translation>
    </message>
    <message>
      <source>Time sheet</source>
      <translation>Zeitaufwand</translation>
    </message>
    <message>
      <source>Audit log</source>
      <translation>Protokoll der Änderungen</translation>
    </message>
    <message>
      <source>Names and times may be exported: consent is given.</source>
      <translation>Namen und Zeiten dürfen exportiert werden: Die Zustimmung liegt vor.</translation>
    </message>
    <message>
      <source>Names and times are not exported: no consent is given (step 4).</source>
      <translation>Namen und Zeiten werden nicht exportiert: Es liegt keine Zustimmung vor (Schritt 4).</translation>
    </message>
    <message>
      <source>Export the time sheet…</source>
      <translation>Zeitblatt exportieren…</translation>
    </message>
    <message>
      <source>Export without names…</source>
      <translation>Ohne Namen exportieren…</translation>
    </message>
    <message>
      <source>Export the time sheet</source>
      <translation>Zeitblatt exportieren</translation>
    </message>
    <message>
      <source>Export without names</source>
      <translation>Ohne Namen exportieren</translation>
    </message>
    <message>
      <source>Undone: {title}</source>
      <translation>Zurückgenommen: {title}</translation>
    </message>
    <message>
      <source>Done again: {title}</source>
      <translation>Wiederholt: {title}</translation>
    </message>
    <message>
      <source>annotated</source>
      <translation>annotiert</translation>
    </message>
    <message>
      <source>accepted by a person</source>
      <translation>von einem Menschen bestätigt</translation>
    </message>
    <message>
      <source>uncertain</source>
      <translation>unsicher</translation>
    </message>
    <message>
      <source>objects</source>
      <translation>Objekte</translation>
    </message>
    <message>
      <source>tracks</source>
      <translation>Spuren</translation>
    </message>
    <message>
      <source>keys per track (mean)</source>
      <translation>Schlüssel je Spur (Mittel)</translation>
    </message>
    <message>
      <source>motion at 256 x 256</source>
      <translation>Bewegung bei 256 x 256</translation>
    </message>
    <message>
      <source>tracks sent back</source>
      <translation>zurückgegebene Spuren</translation>
    </message>
    <message>
      <source>figure</source>
      <translation>Kennzahl</translation>
    </message>
    <message>
      <source>value</source>
      <translation>Wert</translation>
    </message>
    <message>
      <source>what</source>
      <translation>was</translation>
    </message>
    <message>
      <source>who</source>
      <translation>wer</translation>
    </message>
    <message>
      <source>when</source>
      <translation>wann</translation>
    </message>
    <message>
      <source>previous key</source>
      <translation>voriger Schlüssel</translation>
    </message>
    <message>
      <source>first frame</source>
      <translation>erstes Bild</translation>
    </message>
    <message>
      <source>difference</source>
      <translation>Differenz</translation>
    </message>
    <message>
      <source>now</source>
      <translation>jetzt</translation>
    </message>
    <message>
      <source>Compare with a second annotator</source>
      <translation>Mit einer zweiten Person vergleichen</translation>
    </message>
    <message>
      <source>What only they changed is taken over; of conflicts, what you choose (keys 1, 2, 3 for the row). One step; it can be undone.</source>
      <translation>Was nur die anderen geändert haben, wird übernommen; bei Widersprüchen, was Sie wählen (Tasten 1, 2, 3 für die Zeile). Ein Schritt; er lässt sich zurücknehmen.</translation>
    </message>
    <message>
      <source>Merge</source>
      <translation>Zusammenführen</translation>
    </message>
    <message>
      <source>Differences between the two annotators</source>
      <translation>Unterschiede zwischen den beiden Personen</translation>
    </message>
    <message>
      <source>you</source>
      <translation>Sie</translation>
    </message>
    <message>
      <source>them</source>
      <translation>die anderen</translation>
    </message>
    <message>
      <source>both</source>
      <translation>beide</translation>
    </message>
    <message>
      <source>{n} tracks in common. AJ {aj:.1f}, δ {delta:.1f}, OA {oa:.1f} %. Distance where both see the point: median {median:.2f} px, 90 % below {p90:.2f} px (1080 lines). Same state in {states:.1%}.</source>
      <translation>{n} gemeinsame Spuren. AJ {aj:.1f}, δ {delta:.1f}, OA {oa:.1f} %. Abstand, wo beide den Punkt sehen: Median {median:.2f} px, 90 % unter {p90:.2f} px (1080 Zeilen). Gleicher Zustand in {states:.1%}.</translation>
    </message>
    <message>
      <source>point</source>
      <translation>Punkt</translation>
    </message>
    <message>
      <source>frames</source>
      <translation>Bilder</translation>
    </message>
    <message>
      <source>changed by</source>
      <translation>geändert von</translation>
    </message>
    <message>
      <source>distance</source>
      <translation>Abstand</translation>
    </message>
    <message>
      <source>take</source>
      <translation>nehmen</translation>
    </message>
    <message>
      <source>What to take</source>
      <translation>Was übernommen wird</translation>
    </message>
    <message>
      <source>mine</source>
      <translation>meines</translation>
    </message>
    <message>
      <source>theirs</source>
      <translation>ihres</translation>
    </message>
    <message>
      <source>the middle</source>
      <translation>die Mitte</translation>
    </message>
    <message>
      <source>Cut out</source>
      <translation>Ausschneiden</translation>
    </message>
    <message>
      <source>Instead of the selected object's mask</source>
      <translation>Anstelle der Maske des gewählten Objekts</translation>
    </message>
    <message>
      <source>What is drawn replaces its mask in every frame; runs use the new one.</source>
      <translation>Was gezeichnet wird, ersetzt seine Maske in jedem Bild; Läufe nehmen die neue.</translation>
    </message>
    <message>
      <source>very small</source>
      <translation>sehr klein</translation>
    </message>
    <message>
      <source>hardly moves</source>
      <translation>bewegt sich kaum</translation>
    </message>
    <message>
      <source>seen in few frames</source>
      <translation>in wenigen Bildern zu sehen</translation>
    </message>
    <message>
      <source>✓ chosen, ? undecided (! something speaks against it), ✗ left out</source>
      <translation>✓ gewählt, ? offen (! etwas spricht dagegen), ✗ weggelassen</translation>
    </message>
    <message>
      <source>Median share of the frame</source>
      <translation>Mittlerer Anteil am Bild</translation>
    </message>
    <message>
      <source>Pixels per frame at 1080 lines</source>
      <translation>Pixel je Bild bei 1080 Zeilen</translation>
    </message>
    <message>
      <source>Share of frames in which it is seen; of those, in which it is partly hidden</source>
      <translation>Anteil der Bilder, in denen es zu sehen ist; davon die, in denen es teils verdeckt ist</translation>
    </message>
    <message>
      <source>Candidate objects</source>
      <translation>Mögliche Objekte</translation>
    </message>
    <message>
      <source>too small</source>
      <translation>zu klein</translation>
    </message>
    <message>
      <source>does not move</source>
      <translation>bewegt sich nicht</translation>
    </message>
    <message>
      <source>hidden too often</source>
      <translation>zu oft verdeckt</translation>
    </message>
    <message>
      <source>not an object</source>
      <translation>kein Objekt</translation>
    </message>
    <message>
      <source>enough objects</source>
      <translation>genug Objekte</translation>
    </message>
    <message>
      <source>Reason for leaving it out</source>
      <translation>Grund für das Weglassen</translation>
    </message>
    <message>
      <source>object</source>
      <translation>Objekt</translation>
    </message>
    <message>
      <source>size</source>
      <translation>Größe</translation>
    </message>
    <message>
      <source>motion</source>
      <translation>Bewegung</translation>
    </message>
    <message>
      <source>seen/cut</source>
      <translation>zu sehen/verdeckt</translation>
    </message>
    <message>
      <source>At most</source>
      <translation>Höchstens</translation>
    </message>
    <message>
      <source> objects</source>
      <translation> Objekte</translation>
    </message>
    <message>
      <source> points each</source>
      <translation> Punkte je Objekt</translation>
    </message>
    <message>
      <source>Choose</source>
      <translation>Wählen</translation>
    </message>
    <message>
      <source>Leave out:</source>
      <translation>Weglassen:</translation>
    </message>
    <message>
      <source>Earlier</source>
      <translation>Früher</translation>
    </message>
    <message>
      <source>Later</source>
      <translation>Später</translation>
    </message>
    <message>
      <source>Add</source>
      <translation>Neu</translation>
    </message>
    <message>
      <source>box</source>
      <translation>Rechteck</translation>
    </message>
    <message>
      <source>Draw a rectangle around the object</source>
      <translation>Ziehen Sie ein Rechteck um das Objekt</translation>
    </message>
    <message>
      <source>stroke</source>
      <translation>Strich</translation>
    </message>
    <message>
      <source>Click on it or draw over it</source>
      <translation>Klicken Sie darauf oder malen Sie darüber</translation>
    </message>
    <message>
      <source>not this</source>
      <translation>das nicht</translation>
    </message>
    <message>
      <source>Draw over what is not part of it</source>
      <translation>Malen Sie über das, was nicht dazugehört</translation>
    </message>
    <message>
      <source>{n} of at most {most} objects chosen.</source>
      <translation>{n} von höchstens {most} Objekten gewählt.</translation>
    </message>
    <message>
      <source>object {n}</source>
      <translation>Objekt {n}</translation>
    </message>
    <message>
      <source>There are {n} objects already; reject one first.</source>
      <translation>Es sind schon {n} Objekte; verwerfen Sie erst eines.</translation>
    </message>
    <message>
      <source>This frame is not on show yet.</source>
      <translation>Dieses Bild ist noch nicht zu sehen.</translation>
    </message>
    <message>
      <source>All points are placed. Seed the tracks now (Ctrl+G).</source>
      <translation>Alle Punkte sind gesetzt. Verfolgen Sie sie jetzt (Strg+G).</translation>
    </message>
    <message>
      <source>{point} has its place: drag it, or delete its track first.</source>
      <translation>{point} ist schon gesetzt: ziehen, oder zuerst die Spur löschen.</translation>
    </message>
    <message>
      <source>Dope sheet or graphs</source>
      <translation>Zeitübersicht oder Kurven</translation>
    </message>
    <message>
      <source>State that a drag paints</source>
      <translation>Zustand, den Ziehen malt</translation>
    </message>
    <message>
      <source>What a drag over the dope sheet paints</source>
      <translation>Was ein Zug über das Ablaufblatt malt</translation>
    </message>
    <message>
      <source>worst first</source>
      <translation>schlechteste zuerst</translation>
    </message>
    <message>
      <source>Order the rows by suspicion</source>
      <translation>Zeilen nach Verdacht ordnen</translation>
    </message>
    <message>
      <source>Speed</source>
      <translation>Tempo</translation>
    </message>
    <message>
      <source>Dope sheet</source>
      <translation>Zeitübersicht</translation>
    </message>
    <message>
      <source>Graphs</source>
      <translation>Kurven</translation>
    </message>
    <message>
      <source>frame {n} of {last}   {s:.2f} s</source>
      <translation>Bild {n} von {last}   {s:.2f} s</translation>
    </message>
    <message>
      <source>paint {state}</source>
      <translation>{state} malen</translation>
    </message>
    <message>
      <source>free names</source>
      <translation>freie Namen</translation>
    </message>
    <message>
      <source>an animal</source>
      <translation>ein Tier</translation>
    </message>
    <message>
      <source>a person</source>
      <translation>ein Mensch</translation>
    </message>
    <message>
      <source>a fish</source>
      <translation>ein Fisch</translation>
    </message>
    <message>
      <source>a vehicle</source>
      <translation>ein Fahrzeug</translation>
    </message>
    <message>
      <source>a box</source>
      <translation>ein Kasten</translation>
    </message>
    <message>
      <source>Off the object's mask.</source>
      <translation>Außerhalb der Maske des Objekts.</translation>
    </message>
    <message>
      <source>Less than 8 px from another point.</source>
      <translation>Weniger als 8 px von einem anderen Punkt.</translation>
    </message>
    <message>
      <source>Nothing to hold on to: flat.</source>
      <translation>Kein Halt: einfarbig.</translation>
    </message>
    <message>
      <source>Only an edge: it slides along.</source>
      <translation>Nur eine Kante: Der Punkt gleitet daran entlang.</translation>
    </message>
    <message>
      <source>left eye</source>
      <translation>linkes Auge</translation>
    </message>
    <message>
      <source>right eye</source>
      <translation>rechtes Auge</translation>
    </message>
    <message>
      <source>nose</source>
      <translation>Nase</translation>
    </message>
    <message>
      <source>front paw</source>
      <translation>Vorderpfote</translation>
    </message>
    <message>
      <source>tail</source>
      <translation>Schwanz</translation>
    </message>
    <message>
      <source>head</source>
      <translation>Kopf</translation>
    </message>
    <message>
      <source>left hand</source>
      <translation>linke Hand</translation>
    </message>
    <message>
      <source>right hand</source>
      <translation>rechte Hand</translation>
    </message>
    <message>
      <source>left foot</source>
      <translation>linker Fuß</translation>
    </message>
    <message>
      <source>right foot</source>
      <translation>rechter Fuß</translation>
    </message>
    <message>
      <source>eye</source>
      <translation>Auge</translation>
    </message>
    <message>
      <source>mouth</source>
      <translation>Maul</translation>
    </message>
    <message>
      <source>back fin</source>
      <translation>Rückenflosse</translation>
    </message>
    <message>
      <source>belly fin</source>
      <translation>Bauchflosse</translation>
    </message>
    <message>
      <source>front left</source>
      <translation>vorn links</translation>
    </message>
    <message>
      <source>front right</source>
      <translation>vorn rechts</translation>
    </message>
    <message>
      <source>rear left</source>
      <translation>hinten links</translation>
    </message>
    <message>
      <source>rear right</source>
      <translation>hinten rechts</translation>
    </message>
    <message>
      <source>roof</source>
      <translation>Dach</translation>
    </message>
    <message>
      <source>corner 1</source>
      <translation>Ecke 1</translation>
    </message>
    <message>
      <source>corner 2</source>
      <translation>Ecke 2</translation>
    </message>
    <message>
      <source>corner 3</source>
      <translation>Ecke 3</translation>
    </message>
    <message>
      <source>corner 4</source>
      <translation>Ecke 4</translation>
    </message>
    <message>
      <source>centre mark</source>
      <translation>Marke in der Mitte</translation>
    </message>
    <message>
      <source>{point} has its place: drag it or click beside it to move it.</source>
      <translation>{point} ist gesetzt: zum Verschieben ziehen oder daneben klicken.</translation>
    </message>
    <message>
      <source>Template of point names</source>
      <translation>Vorlage für Punktnamen</translation>
    </message>
    <message>
      <source>name of the point</source>
      <translation>Name des Punkts</translation>
    </message>
    <message>
      <source>Name of the active point</source>
      <translation>Name des aktiven Punkts</translation>
    </message>
    <message>
      <source>How well the place under the mouse can be followed</source>
      <translation>Wie gut die Stelle unter der Maus verfolgt werden kann</translation>
    </message>
    <message>
      <source>Seed tracks…</source>
      <translation>Spuren vorschlagen…</translation>
    </message>
    <message>
      <source>A click places {point}.</source>
      <translation>Ein Klick setzt {point}.</translation>
    </message>
    <message>
      <source>Names</source>
      <translation>Namen</translation>
    </message>
    <message>
      <source>Trackable</source>
      <translation>Verfolgbar</translation>
    </message>
    <message>
      <source>Choose objects in step 1 first.</source>
      <translation>Wählen Sie zuerst in Schritt 1 Objekte.</translation>
    </message>
    <message>
      <source>Ctrl and an arrow nudge {point}.</source>
      <translation>Strg und ein Pfeil rücken {point}.</translation>
    </message>
    <message>
      <source>The object is seen from frame {n} on: this track would start late.</source>
      <translation>Das Objekt ist ab Bild {n} zu sehen: Diese Spur finge spät an.</translation>
    </message>
    <message>
      <source>The object is first seen in frame {n}.</source>
      <translation>Das Objekt ist zuerst in Bild {n} zu sehen.</translation>
    </message>
    <message>
      <source>Suspicious spots, worst first</source>
      <translation>Verdächtige Stellen, schlechteste zuerst</translation>
    </message>
    <message>
      <source>tracker</source>
      <translation>Verfolger</translation>
    </message>
    <message>
      <source>flow</source>
      <translation>Fluss</translation>
    </message>
    <message>
      <source>line</source>
      <translation>Gerade</translation>
    </message>
    <message>
      <source>import</source>
      <translation>Import</translation>
    </message>
    <message>
      <source>hold</source>
      <translation>gehalten</translation>
    </message>
    <message>
      <source>note about this track</source>
      <translation>Notiz zu dieser Spur</translation>
    </message>
    <message>
      <source>nothing</source>
      <translation>nichts</translation>
    </message>
    <message>
      <source>Queue: {n} left (N goes to the next)</source>
      <translation>Liste: noch {n} (N geht zur nächsten)</translation>
    </message>
    <message>
      <source>place</source>
      <translation>Stelle</translation>
    </message>
    <message>
      <source>state</source>
      <translation>Zustand</translation>
    </message>
    <message>
      <source>made by</source>
      <translation>gemacht von</translation>
    </message>
    <message>
      <source>why</source>
      <translation>warum</translation>
    </message>
    <message>
      <source>note</source>
      <translation>Notiz</translation>
    </message>
    <message>
      <source>accepted</source>
      <translation>angenommen</translation>
    </message>
    <message>
      <source>snapped</source>
      <translation>eingerastet</translation>
    </message>
    <message>
      <source>Reviewer</source>
      <translation>Prüfer</translation>
    </message>
    <message>
      <source>Reject</source>
      <translation>Verwerfen</translation>
    </message>
    <message>
      <source>The track is given up; it stays in the project.</source>
      <translation>Die Spur wird aufgegeben; sie bleibt im Projekt.</translation>
    </message>
    <message>
      <source>Time and effort may be exported</source>
      <translation>Zeit und Aufwand dürfen exportiert werden</translation>
    </message>
    <message>
      <source>History of the track</source>
      <translation>Verlauf der Spur</translation>
    </message>
    <message>
      <source>What is wrong</source>
      <translation>Was stimmt nicht</translation>
    </message>
    <message>
      <source>your name</source>
      <translation>Ihr Name</translation>
    </message>
    <message>
      <source>Approve</source>
      <translation>Freigeben</translation>
    </message>
    <message>
      <source>Needs a fix:</source>
      <translation>Nacharbeit nötig:</translation>
    </message>
    <message>
      <source>what is wrong there</source>
      <translation>was dort nicht stimmt</translation>
    </message>
    <message>
      <source>Second annotator…</source>
      <translation>Zweiter Annotator…</translation>
    </message>
    <message>
      <source>Log, statistics…</source>
      <translation>Protokoll, Statistik…</translation>
    </message>
    <message>
      <source>No tracks yet.</source>
      <translation>Noch keine Spuren.</translation>
    </message>
    <message>
      <source>Returned to {name}: {reason}</source>
      <translation>An {name} zurückgegeben: {reason}</translation>
    </message>
    <message>
      <source>frames {a} to {b}</source>
      <translation>Bilder {a} bis {b}</translation>
    </message>
    <message>
      <source>frame {a}; [ and ] mark more</source>
      <translation>Bild {a}; [ und ] markieren mehr</translation>
    </message>
    <message>
      <source>its annotator</source>
      <translation>ihren Annotator</translation>
    </message>
    <message>
      <source>The optimisation ended without a scene.</source>
      <translation>Die Optimierung endete ohne Szene.</translation>
    </message>
    <message>
      <source>The optimisation could not be started.</source>
      <translation>Die Optimierung ließ sich nicht starten.</translation>
    </message>
    <message>
      <source>Nothing to snap to here: a click goes where the mouse is.</source>
      <translation>Hier gibt es nichts zum Einrasten: Ein Klick geht dorthin, wo die Maus ist.</translation>
    </message>
    <message>
      <source>Seed tracks</source>
      <translation>Spuren vorschlagen</translation>
    </message>
    <message>
      <source>Your keys, accepted places and painted states stay as they are.</source>
      <translation>Ihre Schlüssel, angenommene Stellen und gemalte Zustände bleiben, wie sie sind.</translation>
    </message>
    <message>
      <source>Seed</source>
      <translation>Vorschlagen</translation>
    </message>
    <message>
      <source>or a scene of this clip that exists</source>
      <translation>oder eine vorhandene Szene dieses Clips</translation>
    </message>
    <message>
      <source>Time</source>
      <translation>Zeit</translation>
    </message>
    <message>
      <source>Scene</source>
      <translation>Szene</translation>
    </message>
    <message>
      <source>a folder of mine</source>
      <translation>ein eigener Ordner</translation>
    </message>
    <message>
      <source>CoTracker 3, downloaded by torch.hub</source>
      <translation>CoTracker 3, von torch.hub geladen</translation>
    </message>
    <message>
      <source>CoTracker 2, downloaded by torch.hub</source>
      <translation>CoTracker 2, von torch.hub geladen</translation>
    </message>
    <message>
      <source>folder of CoTracker's source</source>
      <translation>Ordner mit dem Quelltext von CoTracker</translation>
    </message>
    <message>
      <source>its weights (.pth)</source>
      <translation>seine Gewichte (.pth)</translation>
    </message>
    <message>
      <source>I have read its licence, and this use is not commercial</source>
      <translation>Ich habe die Lizenz gelesen, und diese Nutzung ist nicht kommerziell</translation>
    </message>
    <message>
      <source>Its code and weights may be downloaded and run</source>
      <translation>Sein Code und seine Gewichte dürfen geladen und ausgeführt werden</translation>
    </message>
    <message>
      <source>From</source>
      <translation>Von</translation>
    </message>
    <message>
      <source>Source</source>
      <translation>Quelltext</translation>
    </message>
    <message>
      <source>Weights</source>
      <translation>Gewichte</translation>
    </message>
    <message>
      <source>npz file</source>
      <translation>npz-Datei</translation>
    </message>
    <message>
      <source>File</source>
      <translation>Datei</translation>
    </message>
    <message>
      <source>Optimising. You can close this to cancel.</source>
      <translation>Die Optimierung läuft. Schließen bricht ab.</translation>
    </message>
    <message>
      <source>Following the points through the scene …</source>
      <translation>Die Punkte werden durch die Szene verfolgt …</translation>
    </message>
    <message>
      <source>all objects</source>
      <translation>alle Objekte</translation>
    </message>
    <message>
      <source>the active object only</source>
      <translation>nur das aktive Objekt</translation>
    </message>
    <message>
      <source>Optical (built in)</source>
      <translation>Optisch (eingebaut)</translation>
    </message>
    <message>
      <source>Follows the points inside their masks by flow and matching, from both ends between your keys.</source>
      <translation>Verfolgt die Punkte in ihren Masken durch Fluss und Vergleich, zwischen Ihren Schlüsseln von beiden Enden her.</translation>
    </message>
    <message>
      <source>Solve from scene</source>
      <translation>Aus der Szene lösen</translation>
    </message>
    <message>
      <source>Optimises a 4D scene that follows what you placed so far and takes its tracks, which go on behind what hides them.</source>
      <translation>Optimiert eine 4D-Szene, die dem bisher Gesetzten folgt, und nimmt ihre Spuren, die hinter Verdeckungen weitergehen.</translation>
    </message>
    <message>
      <source>CoTracker (yours)</source>
      <translation>CoTracker (Ihrer)</translation>
    </message>
    <message>
      <source>A checkout and weights that you have. CC BY-NC 4.0: no commercial use. It runs in a process of its own.</source>
      <translation>Quelltext und Gewichte, die Sie haben. CC BY-NC 4.0: keine kommerzielle Nutzung. Läuft in einem eigenen Prozess.</translation>
    </message>
    <message>
      <source>From a file</source>
      <translation>Aus einer Datei</translation>
    </message>
    <message>
      <source>Tracks of this clip that somebody made before: TAP-Vid, CoTracker or ours (npz).</source>
      <translation>Spuren dieses Clips, die es schon gibt: TAP-Vid, CoTracker oder unsere (npz).</translation>
    </message>
    <message>
      <source>CoTracker's licence has to be agreed to first.</source>
      <translation>Der Lizenz von CoTracker muss zuerst zugestimmt werden.</translation>
    </message>
    <message>
      <source>Nothing was seeded; the line below the frame says why.</source>
      <translation>Es wurde nichts gesetzt; die Zeile unter dem Bild sagt, warum.</translation>
    </message>
    <message>
      <source>{n} min of optimising, ready in about {m:.1f} min</source>
      <translation>{n} min optimieren, fertig in etwa {m:.1f} min</translation>
    </message>
    <message>
      <source>Nothing more to take back or do again.</source>
      <translation>Nichts mehr zurückzunehmen oder zu wiederholen.</translation>
    </message>
    <message>
      <source>Accept, go on</source>
      <translation>Bestätigen</translation>
    </message>
    <message>
      <source>Next doubt</source>
      <translation>Nächster Zweifel</translation>
    </message>
    <message>
      <source>Middle of gap</source>
      <translation>Mitte der Lücke</translation>
    </message>
    <message>
      <source>Loop</source>
      <translation>Schleife</translation>
    </message>
    <message>
      <source>Out of view</source>
      <translation>Außerhalb</translation>
    </message>
    <message>
      <source>Key</source>
      <translation>Schlüssel</translation>
    </message>
    <message>
      <source>Snap</source>
      <translation>Einrasten</translation>
    </message>
    <message>
      <source>Delete key</source>
      <translation>Schlüssel weg</translation>
    </message>
    <message>
      <source>Solve</source>
      <translation>Lösen</translation>
    </message>
    <message>
      <source>Track on</source>
      <translation>Vorwärts</translation>
    </message>
    <message>
      <source>Track back</source>
      <translation>Rückwärts</translation>
    </message>
    <message>
      <source>Fill mode</source>
      <translation>Füllart</translation>
    </message>
    <message>
      <source>Seed…</source>
      <translation>Setzen…</translation>
    </message>
    <message>
      <source>Lock</source>
      <translation>Sperren</translation>
    </message>
    <message>
      <source>Delete track</source>
      <translation>Spur löschen</translation>
    </message>
    <message>
      <source>Fit</source>
      <translation>Einpassen</translation>
    </message>
    <message>
      <source>1:1</source>
      <translation>1:1</translation>
    </message>
    <message>
      <source>Follow</source>
      <translation>Folgen</translation>
    </message>
    <message>
      <source>Loupe</source>
      <translation>Lupe</translation>
    </message>
    <message>
      <source>Masks</source>
      <translation>Masken</translation>
    </message>
    <message>
      <source>Trails</source>
      <translation>Schweife</translation>
    </message>
    <message>
      <source>Strip</source>
      <translation>Streifen</translation>
    </message>
    <message>
      <source>Needs a fix</source>
      <translation>Zurückgeben</translation>
    </message>
    <message>
      <source>Compare…</source>
      <translation>Vergleichen…</translation>
    </message>
    <message>
      <source>Log…</source>
      <translation>Protokoll…</translation>
    </message>
    <message>
      <source>Export…</source>
      <translation>Exportieren…</translation>
    </message>
    <message>
      <source>Import…</source>
      <translation>Importieren…</translation>
    </message>
    <message>
      <source>Name…</source>
      <translation>Benennen…</translation>
    </message>
    <message>
      <source>States</source>
      <translation>Zustände</translation>
    </message>
    <message>
      <source>Look</source>
      <translation>Ansicht</translation>
    </message>
    <message>
      <source>Choose at least one object.</source>
      <translation>Wählen Sie mindestens ein Objekt.</translation>
    </message>
    <message>
      <source>Give every chosen object a name.</source>
      <translation>Geben Sie jedem gewählten Objekt einen Namen.</translation>
    </message>
    <message>
      <source>Objects</source>
      <translation>Objekte</translation>
    </message>
    <message>
      <source>Choose the moving objects to annotate, and say why the others are left out.</source>
      <translation>Wählen Sie die bewegten Objekte, und sagen Sie, warum die anderen wegbleiben.</translation>
    </message>
    <message>
      <source>Points and seed</source>
      <translation>Punkte und Vorschlag</translation>
    </message>
    <message>
      <source>Place the key points of every object on its first frame, then seed the tracks.</source>
      <translation>Setzen Sie die Punkte jedes Objekts in seinem ersten Bild, dann die Spuren.</translation>
    </message>
    <message>
      <source>Refine</source>
      <translation>Verfeinern</translation>
    </message>
    <message>
      <source>Step through the clip with Enter; put right what is wrong; N goes to the next doubt.</source>
      <translation>Gehen Sie mit Enter durch den Clip, und berichtigen Sie, was falsch ist; N geht zum nächsten Zweifel.</translation>
    </message>
    <message>
      <source>Review</source>
      <translation>Prüfung</translation>
    </message>
    <message>
      <source>Watch every track; approve it, or return it with a reason.</source>
      <translation>Sehen Sie jede Spur an; geben Sie sie frei oder mit einem Grund zurück.</translation>
    </message>
    <message>
      <source>{n} candidates are neither chosen nor rejected.</source>
      <translation>{n} Kandidaten sind weder gewählt noch verworfen.</translation>
    </message>
    <message>
      <source>{n} points are still to be placed.</source>
      <translation>{n} Punkte sind noch zu setzen.</translation>
    </message>
    <message>
      <source>{n} tracks are not seeded.</source>
      <translation>{n} Spuren haben keinen Vorschlag.</translation>
    </message>
    <message>
      <source>{n} tracks came back from the review.</source>
      <translation>{n} Spuren kamen aus der Prüfung zurück.</translation>
    </message>
    <message>
      <source>{n} points in frames of the stride are not accepted.</source>
      <translation>{n} Punkte in Bildern der Schrittweite sind nicht angenommen.</translation>
    </message>
    <message>
      <source>{n} tracks wait for a decision.</source>
      <translation>{n} Spuren warten auf eine Entscheidung.</translation>
    </message>
    <message>
      <source>History</source>
      <translation>Verlauf</translation>
    </message>
    <message>
      <source>Place</source>
      <translation>Setzen</translation>
    </message>
    <message>
      <source>Step</source>
      <translation>Schritt</translation>
    </message>
    <message>
      <source>Point</source>
      <translation>Punkt</translation>
    </message>
    <message>
      <source>Track</source>
      <translation>Spur</translation>
    </message>
    <message>
      <source>Decide</source>
      <translation>Entscheiden</translation>
    </message>
    <message>
      <source>Together</source>
      <translation>Gemeinsam</translation>
    </message>
    <message>
      <source>More than {n} tracks are not seeded.</source>
      <translation>Mehr als {n} Spuren haben keinen Vorschlag.</translation>
    </message>
    <message>
      <source>More than {n} points in frames of the stride are not accepted.</source>
      <translation>Mehr als {n} Punkte in Bildern der Schrittweite sind nicht angenommen.</translation>
    </message>
    <message>
      <source>Stabilised strip of the active point</source>
      <translation>Stabilisierter Streifen des aktiven Punkts</translation>
    </message>
    <message>
      <source>The active point has no track yet.</source>
      <translation>Der aktive Punkt hat noch keine Spur.</translation>
    </message>
    <message>
      <source>Four steps</source>
      <translation>Vier Schritte</translation>
    </message>
    <message>
      <source>Objects, points, refining, review. Each says what it still lacks. You can go back at any time: Alt+1 to Alt+4.</source>
      <translation>Objekte, Punkte, Verfeinern, Prüfen. Jeder sagt, was noch fehlt. Sie können jederzeit zurück: Alt+1 bis Alt+4.</translation>
    </message>
    <message>
      <source>Every mask is a candidate, with size, motion and how often it is hidden. Select a row and press Choose, or leave it out with a reason.</source>
      <translation>Jede Maske ist ein Kandidat, mit Größe, Bewegung und wie oft sie verdeckt ist. Wählen Sie eine Zeile und drücken Sie Wählen, oder lassen Sie sie mit einem Grund weg.</translation>
    </message>
    <message>
      <source>More objects</source>
      <translation>Weitere Objekte</translation>
    </message>
    <message>
      <source>No mask? Draw a box around the object, or click and scribble on it, then Cut out. It is followed through the clip.</source>
      <translation>Keine Maske? Ziehen Sie einen Kasten um das Objekt, oder klicken und kritzeln Sie darauf, dann Ausschneiden. Es wird durch den Clip verfolgt.</translation>
    </message>
    <message>
      <source>Points</source>
      <translation>Punkte</translation>
    </message>
    <message>
      <source>Click five points on each object; the next one is chosen for you. Hold Z for the loupe, Ctrl and an arrow nudge by a quarter of a pixel.</source>
      <translation>Klicken Sie fünf Punkte auf jedem Objekt; der nächste wird von selbst gewählt. Z halten zeigt die Lupe, Strg und ein Pfeil rücken um ein Viertelpixel.</translation>
    </message>
    <message>
      <source>A good place</source>
      <translation>Eine gute Stelle</translation>
    </message>
    <message>
      <source>A corner can be followed, an edge slides, a flat place is lost. The bar shows it for the place under the mouse.</source>
      <translation>Eine Ecke lässt sich verfolgen, eine Kante gleitet, eine glatte Stelle geht verloren. Der Balken zeigt es für die Stelle unter der Maus.</translation>
    </message>
    <message>
      <source>A tracker proposes the rest. It never overwrites what you placed.</source>
      <translation>Ein Verfolger schlägt den Rest vor. Er überschreibt nie, was Sie gesetzt haben.</translation>
    </message>
    <message>
      <source>Fill: visible. Hatch: occluded. Diamond: your key. Red: doubtful. Click to go there, drag to paint a state.</source>
      <translation>Fläche: sichtbar. Schraffur: verdeckt. Raute: Ihr Schlüssel. Rot: zweifelhaft. Klicken geht dorthin, Ziehen malt einen Zustand.</translation>
    </message>
    <message>
      <source>Enter accepts the points of a frame and goes on. Drag a point that is off: both segments beside it are solved again. Hold Q and step to paint occlusion.</source>
      <translation>Enter bestätigt die Punkte eines Bildes und geht weiter. Ziehen Sie einen falschen Punkt: Beide Abschnitte daneben werden neu gelöst. Q halten und weitergehen malt Verdeckung.</translation>
    </message>
    <message>
      <source>The queue</source>
      <translation>Die Liste</translation>
    </message>
    <message>
      <source>N goes to the next most suspicious spot, and says why it is suspicious.</source>
      <translation>N geht zur nächsten verdächtigen Stelle und sagt, warum sie verdächtig ist.</translation>
    </message>
    <message>
      <source>Somebody else approves each track, or returns it with a reason. Everything is stored as you work; Ctrl+Z takes back anything, even tomorrow.</source>
      <translation>Jemand anders gibt jede Spur frei oder mit einem Grund zurück. Alles wird beim Arbeiten gespeichert; Strg+Z nimmt alles zurück, auch morgen.</translation>
    </message>
    <message>
      <source>End the tour</source>
      <translation>Rundgang beenden</translation>
    </message>
    <message>
      <source>Back</source>
      <translation>Zurück</translation>
    </message>
    <message>
      <source>Next</source>
      <translation>Weiter</translation>
    </message>
    <message>
      <source>Done</source>
      <translation>Fertig</translation>
    </message>
    <message>
      <source>none</source>
      <translation>keiner</translation>
    </message>
    <message>
      <source>draft</source>
      <translation>Entwurf</translation>
    </message>
    <message>
      <source>in progress</source>
      <translation>in Arbeit</translation>
    </message>
    <message>
      <source>needs a fix</source>
      <translation>Nacharbeit nötig</translation>
    </message>
    <message>
      <source>fixed</source>
      <translation>behoben</translation>
    </message>
    <message>
      <source>approved</source>
      <translation>freigegeben</translation>
    </message>
    <message>
      <source>rejected</source>
      <translation>verworfen</translation>
    </message>
    <message>
      <source>doubt</source>
      <translation>Zweifel</translation>
    </message>
    <message>
      <source>review</source>
      <translation>Prüfung</translation>
    </message>
    <message>
      <source>placed</source>
      <translation>gesetzt</translation>
    </message>
    <message>
      <source>Objects and points</source>
      <translation>Objekte und Punkte</translation>
    </message>
    <message>
      <source>frame {n}, late</source>
      <translation>Bild {n}, spät</translation>
    </message>
    <message>
      <source>frame {n}</source>
      <translation>Bild {n}</translation>
    </message>
    <message>
      <source>The clip is still being read.</source>
      <translation>Der Clip wird noch gelesen.</translation>
    </message>
    <message>
      <source>There are no masks to track in: make one in step 1.</source>
      <translation>Es gibt keine Masken, in denen verfolgt werden kann: legen Sie in Schritt 1 eine an.</translation>
    </message>
    <message>
      <source>Solving …</source>
      <translation>Wird gelöst …</translation>
    </message>
    <message>
      <source>Place this point first.</source>
      <translation>Setzen Sie zuerst diesen Punkt.</translation>
    </message>
    <message>
      <source>Seeding {n} tracks …</source>
      <translation>{n} Spuren werden vorgeschlagen …</translation>
    </message>
    <message>
      <source>Place points first.</source>
      <translation>Setzen Sie zuerst Punkte.</translation>
    </message>
    <message>
      <source>Seeding by {name} …</source>
      <translation>{name} setzt Spuren …</translation>
    </message>
    <message>
      <source>The object is not seen in both frames; the point stays where it is.</source>
      <translation>Das Objekt ist nicht in beiden Bildern zu sehen; der Punkt bleibt, wo er ist.</translation>
    </message>
    <message>
      <source>{n} tracks are seeded.</source>
      <translation>{n} Spuren haben nun einen Vorschlag.</translation>
    </message>
    <message>
      <source>Choose an object first (step 1).</source>
      <translation>Wählen Sie zuerst ein Objekt (Schritt 1).</translation>
    </message>
    <message>
      <source>A point begins where it is seen: click inside the picture.</source>
      <translation>Ein Punkt beginnt, wo er zu sehen ist: ins Bild klicken.</translation>
    </message>
    <message>
      <source>The point is outside the picture, yet marked visible: O marks it as out of view.</source>
      <translation>Der Punkt liegt außerhalb des Bilds, gilt aber als sichtbar: O setzt ihn auf außer Sicht.</translation>
    </message>
    <message>
      <source>The point has no place in this frame.</source>
      <translation>Der Punkt hat in diesem Bild keinen Ort.</translation>
    </message>
    <message>
      <source>Look at this point, then press Enter again.</source>
      <translation>Sehen Sie diesen Punkt an und drücken Sie noch einmal Enter.</translation>
    </message>
    <message>
      <source>This segment is filled by: {mode}</source>
      <translation>Dieser Abschnitt wird gefüllt durch: {mode}</translation>
    </message>
    <message>
      <source>Cutting the object out of every frame …</source>
      <translation>Das Objekt wird aus jedem Bild geschnitten …</translation>
    </message>
    <message>
      <source>Reading the clip …</source>
      <translation>Der Clip wird gelesen …</translation>
    </message>
    <message>
      <source>{n} strokes; press Cut out.</source>
      <translation>{n} Striche; drücken Sie Ausschneiden.</translation>
    </message>
    <message>
      <source>Draw something first.</source>
      <translation>Malen Sie zuerst etwas.</translation>
    </message>
    <message>
      <source>Steps</source>
      <translation>Schritte</translation>
    </message>
    <message>
      <source>Open a clip to annotate it (Ctrl+O).</source>
      <translation>Öffnen Sie einen Clip, um ihn zu annotieren (Strg+O).</translation>
    </message>
    <message>
      <source>read only</source>
      <translation>nur lesen</translation>
    </message>
    <message>
      <source>saved</source>
      <translation>gespeichert</translation>
    </message>
    <message>
      <source>Information</source>
      <translation>Information</translation>
    </message>
    <message>
      <source>saved in {ms:.0f} ms</source>
      <translation>gespeichert in {ms:.0f} ms</translation>
    </message>
    <message>
      <source>Workspaces</source>
      <translation>Arbeitsbereiche</translation>
    </message>
    <message>
      <source>Find a command…  Ctrl+K</source>
      <translation>Befehl suchen…  Strg+K</translation>
    </message>
    <message>
      <source>Panels</source>
      <translation>Bereiche</translation>
    </message>
    <message>
      <source>Hides all panels, so that the pictures fill the window, or shows them (Ctrl+B)</source>
      <translation>Blendet alle Bereiche aus, damit die Bilder das Fenster füllen, oder wieder ein (Strg+B)</translation>
    </message>
    <message>
      <source>Start</source>
      <translation>Start</translation>
    </message>
    <message>
      <source>The start page</source>
      <translation>Die Startseite</translation>
    </message>
    <message>
      <source>Annotate</source>
      <translation>Annotieren</translation>
    </message>
    <message>
      <source>Points and masks by hand (Ctrl+1)</source>
      <translation>Punkte und Masken von Hand (Strg+1)</translation>
    </message>
    <message>
      <source>Watch</source>
      <translation>Ansehen</translation>
    </message>
    <message>
      <source>Optimise, look at and compare scenes (Ctrl+2)</source>
      <translation>Optimieren, Szenen ansehen und vergleichen (Strg+2)</translation>
    </message>
    <message>
      <source>This is a fault of ours, not of your data. Your annotations are on disk. The details help us to mend it.</source>
      <translation>Das ist ein Fehler von uns, nicht Ihrer Daten. Ihre Annotationen sind gespeichert. Die Einzelheiten helfen uns, ihn zu beheben.</translation>
    </message>
    <message>
      <source>A fault of the app</source>
      <translation>Ein Fehler der App</translation>
    </message>
    <message>
      <source>That did not work</source>
      <translation>Das ging nicht</translation>
    </message>
    <message>
      <source>What do you want to do?</source>
      <translation>Was möchten Sie tun?</translation>
    </message>
    <message>
      <source>Hard cases on this machine</source>
      <translation>Harte Fälle auf diesem Rechner</translation>
    </message>
    <message>
      <source>Some minutes: hostile splats, masks, depths and numbers that go bad.</source>
      <translation>Einige Minuten: feindliche Splats, Masken, Tiefen und Zahlen, die entgleisen.</translation>
    </message>
    <message>
      <source>Row</source>
      <translation>Zeile</translation>
    </message>
    <message>
      <source>Case</source>
      <translation>Fall</translation>
    </message>
    <message>
      <source>What happened</source>
      <translation>Was geschah</translation>
    </message>
    <message>
      <source>Verdict</source>
      <translation>Urteil</translation>
    </message>
    <message>
      <source>Seconds</source>
      <translation>Sekunden</translation>
    </message>
    <message>
      <source>The self-test ended without a result.</source>
      <translation>Der Selbsttest endete ohne Ergebnis.</translation>
    </message>
    <message>
      <source>holds</source>
      <translation>hält</translation>
    </message>
    <message>
      <source>broken</source>
      <translation>gebrochen</translation>
    </message>
    <message>
      <source>{cases} cases, {failed} broken, {seconds:.0f} s.</source>
      <translation>{cases} Fälle, {failed} gebrochen, {seconds:.0f} s.</translation>
    </message>
    <message>
      <source>All shortcuts</source>
      <translation>Alle Tasten</translation>
    </message>
    <message>
      <source>Shortcuts and settings</source>
      <translation>Tasten und Einstellungen</translation>
    </message>
    <message>
      <source>The language changes when the app starts again.</source>
      <translation>Die Sprache wechselt beim nächsten Start der App.</translation>
    </message>
    <message>
      <source>Set</source>
      <translation>Setzen</translation>
    </message>
    <message>
      <source>As delivered</source>
      <translation>Wie geliefert</translation>
    </message>
    <message>
      <source>Other</source>
      <translation>Weitere</translation>
    </message>
    <message>
      <source>Search</source>
      <translation>Suchen</translation>
    </message>
    <message>
      <source>Command</source>
      <translation>Befehl</translation>
    </message>
    <message>
      <source>Keys</source>
      <translation>Tasten</translation>
    </message>
    <message>
      <source>What it does</source>
      <translation>Was er tut</translation>
    </message>
    <message>
      <source>Keys as in</source>
      <translation>Tasten wie in</translation>
    </message>
    <message>
      <source>Language (after a restart)</source>
      <translation>Sprache (nach einem Neustart)</translation>
    </message>
    <message>
      <source>New key</source>
      <translation>Neue Taste</translation>
    </message>
    <message>
      <source>{key} is used by “{first}” and “{second}”.</source>
      <translation>{key} gehört schon zu „{first}“ und „{second}“.</translation>
    </message>
    <message>
      <source>As the system</source>
      <translation>Wie das System</translation>
    </message>
    <message>
      <source>Preparing the drawing kernels, once on this computer …</source>
      <translation>Die Zeichenkerne werden vorbereitet, einmal auf diesem Rechner …</translation>
    </message>
    <message>
      <source>No OpenGL here: the processor draws. Everything works, large scenes turn slower.</source>
      <translation>Kein OpenGL: der Prozessor zeichnet. Alles geht, große Szenen drehen sich langsamer.</translation>
    </message>
    <message>
      <source>OpenGL is emulated here: the processor draws directly, which is faster.</source>
      <translation>OpenGL wird hier nachgeahmt: der Prozessor zeichnet direkt, das ist schneller.</translation>
    </message>
    <message>
      <source>scene units</source>
      <translation>Szeneneinheiten</translation>
    </message>
    <message>
      <source>of full scale</source>
      <translation>der vollen Skala</translation>
    </message>
    <message>
      <source>elevation {degrees:+.1f}°</source>
      <translation>Höhe {degrees:+.1f}°</translation>
    </message>
    <message>
      <source>azimuth {degrees:+.1f}°</source>
      <translation>Azimut {degrees:+.1f}°</translation>
    </message>
    <message>
      <source>Not seen: {angle:.0f}° from the nearest supervised view.</source>
      <translation>Nicht gesehen: {angle:.0f}° von der nächsten überwachten Ansicht.</translation>
    </message>
    <message>
      <source>roll {degrees:+.1f}°</source>
      <translation>Rollen {degrees:+.1f}°</translation>
    </message>
    <message>
      <source>Drag to turn, Shift+drag to move, wheel to go nearer; click to ask what is there</source>
      <translation>Ziehen dreht, Umschalt+Ziehen verschiebt, das Rad holt näher; ein Klick fragt, was dort ist</translation>
    </message>
    <message>
      <source>The view cannot be drawn: {reason}</source>
      <translation>Die Ansicht kann nicht gezeichnet werden: {reason}</translation>
    </message>
    <message>
      <source>Edge</source>
      <translation>Kante</translation>
    </message>
    <message>
      <source>Share of the scene</source>
      <translation>Anteil der Szene</translation>
    </message>
    <message>
      <source>Gain</source>
      <translation>Verstärkung</translation>
    </message>
    <message>
      <source>Input</source>
      <translation>Eingabe</translation>
    </message>
    <message>
      <source>No clip is open</source>
      <translation>Kein Clip ist offen</translation>
    </message>
    <message>
      <source>Waiting for the scene at the input camera …</source>
      <translation>Warten auf die Szene an der Eingabekamera …</translation>
    </message>
    <message>
      <source>Input  |  scene</source>
      <translation>Eingabe  |  Szene</translation>
    </message>
    <message>
      <source>Input and scene</source>
      <translation>Eingabe und Szene</translation>
    </message>
    <message>
      <source>Difference × {gain:.1f}</source>
      <translation>Differenz × {gain:.1f}</translation>
    </message>
    <message>
      <source>Stop the run and throw its scene away?</source>
      <translation>Den Lauf beenden und seine Szene verwerfen?</translation>
    </message>
    <message>
      <source>Save the curves</source>
      <translation>Kurven speichern</translation>
    </message>
    <message>
      <source>Open a run folder</source>
      <translation>Ordner eines Laufs öffnen</translation>
    </message>
    <message>
      <source>Background</source>
      <translation>Hintergrund</translation>
    </message>
    <message>
      <source>Without motion</source>
      <translation>Ohne Bewegung</translation>
    </message>
    <message>
      <source>Show all objects</source>
      <translation>Alle Objekte zeigen</translation>
    </message>
    <message>
      <source>Solo</source>
      <translation>Allein zeigen</translation>
    </message>
    <message>
      <source>step</source>
      <translation>Schritt</translation>
    </message>
    <message>
      <source>Off</source>
      <translation>Aus</translation>
    </message>
    <message>
      <source>Side by side</source>
      <translation>Nebeneinander</translation>
    </message>
    <message>
      <source>Wipe</source>
      <translation>Wischen</translation>
    </message>
    <message>
      <source>Blink</source>
      <translation>Blinken</translation>
    </message>
    <message>
      <source>Difference</source>
      <translation>Differenz</translation>
    </message>
    <message>
      <source>Choose another scene, or freeze this one, and compare as it goes on.</source>
      <translation>Wählen Sie eine andere Szene, oder frieren Sie diese ein und vergleichen Sie, während es weitergeht.</translation>
    </message>
    <message>
      <source>A file…</source>
      <translation>Eine Datei…</translation>
    </message>
    <message>
      <source>Choose a scene</source>
      <translation>Szene wählen</translation>
    </message>
    <message>
      <source>PSNR of this frame (dB)</source>
      <translation>PSNR dieses Bilds (dB)</translation>
    </message>
    <message>
      <source>Freeze what is on show</source>
      <translation>Gezeigtes einfrieren</translation>
    </message>
    <message>
      <source>Figure</source>
      <translation>Kennzahl</translation>
    </message>
    <message>
      <source>On show</source>
      <translation>Gezeigt</translation>
    </message>
    <message>
      <source>held-out PSNR (dB)</source>
      <translation>PSNR zurückgehalten (dB)</translation>
    </message>
    <message>
      <source>Checkpoint at step {step}</source>
      <translation>Prüfpunkt bei Schritt {step}</translation>
    </message>
    <message>
      <source>{name}, frozen at step {step}</source>
      <translation>{name}, eingefroren bei Schritt {step}</translation>
    </message>
    <message>
      <source>the next minute buys {gain:+.2f} ± {spread:.2f} dB</source>
      <translation>die nächste Minute bringt {gain:+.2f} ± {spread:.2f} dB</translation>
    </message>
    <message>
      <source>Logarithmic</source>
      <translation>Logarithmisch</translation>
    </message>
    <message>
      <source>Smooth</source>
      <translation>Glätten</translation>
    </message>
    <message>
      <source>seconds</source>
      <translation>Sekunden</translation>
    </message>
    <message>
      <source>measured</source>
      <translation>gemessen</translation>
    </message>
    <message>
      <source>expected</source>
      <translation>erwartet</translation>
    </message>
    <message>
      <source>worker</source>
      <translation>Arbeitsprozess</translation>
    </message>
    <message>
      <source>Accuracy against time</source>
      <translation>Genauigkeit über der Zeit</translation>
    </message>
    <message>
      <source>Losses</source>
      <translation>Verluste</translation>
    </message>
    <message>
      <source>weighted loss</source>
      <translation>gewichteter Verlust</translation>
    </message>
    <message>
      <source>Gaussians</source>
      <translation>Gaußglocken</translation>
    </message>
    <message>
      <source>Time of a step</source>
      <translation>Zeit eines Schritts</translation>
    </message>
    <message>
      <source>ms</source>
      <translation>ms</translation>
    </message>
    <message>
      <source>Memory</source>
      <translation>Speicher</translation>
    </message>
    <message>
      <source>MB</source>
      <translation>MB</translation>
    </message>
    <message>
      <source>median {value:.0f}</source>
      <translation>Median {value:.0f}</translation>
    </message>
    <message>
      <source>The clip could not be measured.</source>
      <translation>Der Clip konnte nicht vermessen werden.</translation>
    </message>
    <message>
      <source>Effect</source>
      <translation>Effekt</translation>
    </message>
    <message>
      <source>Evidence</source>
      <translation>Beleg</translation>
    </message>
    <message>
      <source>Cost</source>
      <translation>Kosten</translation>
    </message>
    <message>
      <source>Joint occlusion</source>
      <translation>Gemeinsame Verdeckung</translation>
    </message>
    <message>
      <source>Camera motion</source>
      <translation>Kamerabewegung</translation>
    </message>
    <message>
      <source>Bending motion</source>
      <translation>Verformung</translation>
    </message>
    <message>
      <source>Changing light</source>
      <translation>Wechselndes Licht</translation>
    </message>
    <message>
      <source>Shading of what turns</source>
      <translation>Schattierung beim Drehen</translation>
    </message>
    <message>
      <source>Unseen views</source>
      <translation>Ungesehene Ansichten</translation>
    </message>
    <message>
      <source>Object labels</source>
      <translation>Objektnummern</translation>
    </message>
    <message>
      <source>Depth order</source>
      <translation>Tiefenordnung</translation>
    </message>
    <message>
      <source>Optical flow</source>
      <translation>Optischer Fluss</translation>
    </message>
    <message>
      <source>Point tracks</source>
      <translation>Punktspuren</translation>
    </message>
    <message>
      <source>Reappearance</source>
      <translation>Wiederauftauchen</translation>
    </message>
    <message>
      <source>Measured {evidence}; on from {bound} ({origin}).</source>
      <translation>Gemessen {evidence}; an ab {bound} ({origin}).</translation>
    </message>
    <message>
      <source>Costs about {ms:.1f} ms per step and {mb:.1f} MB.</source>
      <translation>Kostet etwa {ms:.1f} ms je Schritt und {mb:.1f} MB.</translation>
    </message>
    <message>
      <source>Measured here: {ms:.1f} ms per step ('{ms_clip}').</source>
      <translation>Hier gemessen: {ms:.1f} ms je Schritt („{ms_clip}“).</translation>
    </message>
    <message>
      <source>Gained here: {psnr:+.2f} dB ('{psnr_clip}').</source>
      <translation>Hier gewonnen: {psnr:+.2f} dB („{psnr_clip}“).</translation>
    </message>
    <message>
      <source>Picture of this view</source>
      <translation>Bild dieser Ansicht</translation>
    </message>
    <message>
      <source>Transparent behind the scene</source>
      <translation>Durchsichtig hinter der Szene</translation>
    </message>
    <message>
      <source>Width</source>
      <translation>Breite</translation>
    </message>
    <message>
      <source>Height</source>
      <translation>Höhe</translation>
    </message>
    <message>
      <source>Turntable video</source>
      <translation>Drehtisch-Video</translation>
    </message>
    <message>
      <source>Pictures with a transparent background</source>
      <translation>Bilder mit durchsichtigem Hintergrund</translation>
    </message>
    <message>
      <source>Colour</source>
      <translation>Farbe</translation>
    </message>
    <message>
      <source>Depth</source>
      <translation>Tiefe</translation>
    </message>
    <message>
      <source>Motion to the next frame</source>
      <translation>Bewegung zum nächsten Bild</translation>
    </message>
    <message>
      <source>Coverage</source>
      <translation>Deckung</translation>
    </message>
    <message>
      <source>Surface direction</source>
      <translation>Flächenrichtung</translation>
    </message>
    <message>
      <source>This frame</source>
      <translation>Dieses Bild</translation>
    </message>
    <message>
      <source>The clip once</source>
      <translation>Der Clip einmal</translation>
    </message>
    <message>
      <source>The clip again and again</source>
      <translation>Der Clip immer wieder</translation>
    </message>
    <message>
      <source>Length</source>
      <translation>Länge</translation>
    </message>
    <message>
      <source>Pictures a second</source>
      <translation>Bilder je Sekunde</translation>
    </message>
    <message>
      <source>Turn</source>
      <translation>Drehung</translation>
    </message>
    <message>
      <source>Elevation</source>
      <translation>Höhe</translation>
    </message>
    <message>
      <source>Short side</source>
      <translation>Kurze Seite</translation>
    </message>
    <message>
      <source>Show</source>
      <translation>Zeigen</translation>
    </message>
    <message>
      <source>Scene time</source>
      <translation>Zeit der Szene</translation>
    </message>
    <message>
      <source>A run is going on. What becomes of it?</source>
      <translation>Ein Lauf ist im Gang. Was soll mit ihm geschehen?</translation>
    </message>
    <message>
      <source>A run that goes on alone is listed on the start page; open it there to watch it again.</source>
      <translation>Ein Lauf, der allein weitergeht, steht auf der Startseite; öffnen Sie ihn dort, um ihn wieder anzusehen.</translation>
    </message>
    <message>
      <source>Let it go on</source>
      <translation>Weiterlaufen lassen</translation>
    </message>
    <message>
      <source>Stop and keep the scene</source>
      <translation>Beenden und Szene behalten</translation>
    </message>
    <message>
      <source>Stop and throw it away</source>
      <translation>Beenden und verwerfen</translation>
    </message>
    <message>
      <source>No scene yet. Start a run (F5), or open a scene file.</source>
      <translation>Noch keine Szene. Starten Sie einen Lauf (F5) oder öffnen Sie eine Szene.</translation>
    </message>
    <message>
      <source>Turn the view</source>
      <translation>Ansicht drehen</translation>
    </message>
    <message>
      <source>Moves the objects apart</source>
      <translation>Rückt die Objekte auseinander</translation>
    </message>
    <message>
      <source>Show or hide an object</source>
      <translation>Objekt zeigen oder verbergen</translation>
    </message>
    <message>
      <source>Move objects apart</source>
      <translation>Objekte auseinanderrücken</translation>
    </message>
    <message>
      <source>Object</source>
      <translation>Objekt</translation>
    </message>
    <message>
      <source>Apart</source>
      <translation>Abstand</translation>
    </message>
    <message>
      <source>Tint of the object</source>
      <translation>Farbe des Objekts</translation>
    </message>
    <message>
      <source>Tint an object</source>
      <translation>Objekt färben</translation>
    </message>
    <message>
      <source>All</source>
      <translation>Alle</translation>
    </message>
    <message>
      <source>Tint…</source>
      <translation>Färben…</translation>
    </message>
    <message>
      <source>Edit this mask…</source>
      <translation>Diese Maske bearbeiten…</translation>
    </message>
    <message>
      <source>A number of the run; a change takes effect at the next step</source>
      <translation>Eine Zahl des Laufs; eine Änderung gilt ab dem nächsten Schritt</translation>
    </message>
    <message>
      <source>Camera path</source>
      <translation>Kamerafahrt</translation>
    </message>
    <message>
      <source>Back to the first key</source>
      <translation>Zurück zum ersten Schlüssel</translation>
    </message>
    <message>
      <source>Load a camera path</source>
      <translation>Kamerafahrt laden</translation>
    </message>
    <message>
      <source>Save the camera path</source>
      <translation>Kamerafahrt speichern</translation>
    </message>
    <message>
      <source>Arrives (s)</source>
      <translation>Ankunft (s)</translation>
    </message>
    <message>
      <source>Frame</source>
      <translation>Bild</translation>
    </message>
    <message>
      <source>Field of view (°)</source>
      <translation>Bildwinkel (°)</translation>
    </message>
    <message>
      <source>Stays (s)</source>
      <translation>Halt (s)</translation>
    </message>
    <message>
      <source>Move the view, choose a frame, and add a key. Numbers can be typed over.</source>
      <translation>Bewegen Sie die Ansicht, wählen Sie ein Bild und fügen Sie einen Schlüssel hinzu. Zahlen lassen sich überschreiben.</translation>
    </message>
    <message>
      <source>Load…</source>
      <translation>Laden…</translation>
    </message>
    <message>
      <source>Save…</source>
      <translation>Speichern…</translation>
    </message>
    <message>
      <source>Render…</source>
      <translation>Rendern…</translation>
    </message>
    <message>
      <source>Add a key here</source>
      <translation>Schlüssel hier hinzufügen</translation>
    </message>
    <message>
      <source>Take this view</source>
      <translation>Diese Ansicht nehmen</translation>
    </message>
    <message>
      <source>Delete</source>
      <translation>Löschen</translation>
    </message>
    <message>
      <source>{count} Gaussians cover {coverage:.0f} % of pixel ({x:.0f}, {y:.0f}); depth {depth:.3f}.</source>
      <translation>{count} Gaußglocken decken {coverage:.0f} % von Pixel ({x:.0f}, {y:.0f}); Tiefe {depth:.3f}.</translation>
    </message>
    <message>
      <source>Click a place in the scene to see which Gaussians make its colour.</source>
      <translation>Klicken Sie eine Stelle der Szene an, um zu sehen, welche Gaußglocken ihre Farbe ergeben.</translation>
    </message>
    <message>
      <source>Share</source>
      <translation>Anteil</translation>
    </message>
    <message>
      <source>Opacity</source>
      <translation>Deckkraft</translation>
    </message>
    <message>
      <source>Number</source>
      <translation>Nummer</translation>
    </message>
    <message>
      <source>Position</source>
      <translation>Ort</translation>
    </message>
    <message>
      <source>Turn (°)</source>
      <translation>Drehung (°)</translation>
    </message>
    <message>
      <source>Size</source>
      <translation>Größe</translation>
    </message>
    <message>
      <source>Nothing is there.</source>
      <translation>Dort ist nichts.</translation>
    </message>
    <message>
      <source>Skip</source>
      <translation>Überspringen</translation>
    </message>
    <message>
      <source>Decibels are then foretold from the clip's pixels alone.</source>
      <translation>Die Dezibel werden dann allein aus den Pixeln des Clips vorhergesagt.</translation>
    </message>
    <message>
      <source>A pilot, the clip run small and short, takes about {time}, to foretell decibels better.</source>
      <translation>Ein Probelauf, der Clip klein und kurz gerechnet, dauert etwa {time}; er sagt die Dezibel genauer vorher.</translation>
    </message>
    <message>
      <source>Size, Gaussians and pace are chosen so that the budget buys most.</source>
      <translation>Größe, Gaußglocken und Tempo werden so gewählt, dass das Budget am meisten bringt.</translation>
    </message>
    <message>
      <source>Draft</source>
      <translation>Entwurf</translation>
    </message>
    <message>
      <source>Standard</source>
      <translation>Standard</translation>
    </message>
    <message>
      <source>Full (as the paper)</source>
      <translation>Voll (wie im Artikel)</translation>
    </message>
    <message>
      <source>Best for the budget</source>
      <translation>Das Beste für das Budget</translation>
    </message>
    <message>
      <source>The run ends after this time with what it has.</source>
      <translation>Der Lauf endet nach dieser Zeit mit dem, was er hat.</translation>
    </message>
    <message>
      <source>Preset</source>
      <translation>Voreinstellung</translation>
    </message>
    <message>
      <source>Budget</source>
      <translation>Zeitbudget</translation>
    </message>
    <message>
      <source>Device</source>
      <translation>Gerät</translation>
    </message>
    <message>
      <source>Expected: {time} (± {spread}), {psnr:.1f} dB (± {error:.1f}), </source>
      <translation>Erwartet: {time} (± {spread}), {psnr:.1f} dB (± {error:.1f}), </translation>
    </message>
    <message>
      <source>Expected: {time} (± {spread}), {psnr:.1f} dB (± {error:.1f}, from a pilot run), </source>
      <translation>Erwartet: {time} (± {spread}), {psnr:.1f} dB (± {error:.1f}, aus einem Probelauf), </translation>
    </message>
    <message>
      <source>Automatic</source>
      <translation>Automatisch</translation>
    </message>
    <message>
      <source>Processor</source>
      <translation>Prozessor</translation>
    </message>
    <message>
      <source>Graphics card (CUDA)</source>
      <translation>Grafikkarte (CUDA)</translation>
    </message>
    <message>
      <source>Open a clip to start a run.</source>
      <translation>Öffnen Sie einen Clip, um einen Lauf zu starten.</translation>
    </message>
    <message>
      <source>Measuring what the clip calls for …</source>
      <translation>Es wird gemessen, was der Clip verlangt …</translation>
    </message>
    <message>
      <source>The last run: expected {time} and {psnr:.1f} dB, took {took}, {got:.1f} dB on pixels that were held out.</source>
      <translation>Der letzte Lauf: erwartet {time} und {psnr:.1f} dB, gedauert {took}, {got:.1f} dB auf zurückgehaltenen Pixeln.</translation>
    </message>
    <message>
      <source>no limit</source>
      <translation>unbegrenzt</translation>
    </message>
    <message>
      <source>That is more than this machine has free: choose a smaller preset.</source>
      <translation>Das ist mehr, als diese Maschine frei hat: wählen Sie eine kleinere Voreinstellung.</translation>
    </message>
    <message>
      <source>The run uses the masks that were corrected here.</source>
      <translation>Der Lauf nimmt die hier verbesserten Masken.</translation>
    </message>
    <message>
      <source>about {mb:.1f} GB of memory.</source>
      <translation>etwa {mb:.1f} GB Speicher.</translation>
    </message>
    <message>
      <source>Stop when a minute buys less than</source>
      <translation>Beenden, wenn eine Minute weniger bringt als</translation>
    </message>
    <message>
      <source>Resume from the checkpoint</source>
      <translation>Vom Prüfpunkt fortsetzen</translation>
    </message>
    <message>
      <source>Change while it runs</source>
      <translation>Während des Laufs ändern</translation>
    </message>
    <message>
      <source>the goal is reached</source>
      <translation>das Ziel ist erreicht</translation>
    </message>
    <message>
      <source>the budget is used up</source>
      <translation>das Budget ist aufgebraucht</translation>
    </message>
    <message>
      <source>stopped early</source>
      <translation>vorzeitig beendet</translation>
    </message>
    <message>
      <source>No run</source>
      <translation>Kein Lauf</translation>
    </message>
    <message>
      <source>Starting</source>
      <translation>Startet</translation>
    </message>
    <message>
      <source>Preparing</source>
      <translation>Bereitet vor</translation>
    </message>
    <message>
      <source>Running</source>
      <translation>Läuft</translation>
    </message>
    <message>
      <source>Paused</source>
      <translation>Angehalten</translation>
    </message>
    <message>
      <source>Stepping</source>
      <translation>Einzelschritt</translation>
    </message>
    <message>
      <source>Stopping</source>
      <translation>Endet</translation>
    </message>
    <message>
      <source>Writing the scene</source>
      <translation>Schreibt die Szene</translation>
    </message>
    <message>
      <source>Failed</source>
      <translation>Fehlgeschlagen</translation>
    </message>
    <message>
      <source>No sign of life</source>
      <translation>Kein Lebenszeichen</translation>
    </message>
    <message>
      <source>step {step}, {count} Gaussians</source>
      <translation>Schritt {step}, {count} Gaußglocken</translation>
    </message>
    <message>
      <source>the view costs {share:.1f} %</source>
      <translation>die Ansicht kostet {share:.1f} %</translation>
    </message>
    <message>
      <source>{time} left</source>
      <translation>noch {time}</translation>
    </message>
    <message>
      <source>Reading {name} …</source>
      <translation>{name} wird gelesen …</translation>
    </message>
    <message>
      <source>Save the scene</source>
      <translation>Szene speichern</translation>
    </message>
    <message>
      <source>Save this frame</source>
      <translation>Dieses Bild speichern</translation>
    </message>
    <message>
      <source>Folder for the PLY files</source>
      <translation>Ordner für die PLY-Dateien</translation>
    </message>
    <message>
      <source>Cancel</source>
      <translation>Abbrechen</translation>
    </message>
    <message>
      <source>Save the video</source>
      <translation>Video speichern</translation>
    </message>
    <message>
      <source>Save the picture</source>
      <translation>Bild speichern</translation>
    </message>
    <message>
      <source>Save the scene first; videos are made from its file.</source>
      <translation>Speichern Sie zuerst die Szene; Videos entstehen aus ihrer Datei.</translation>
    </message>
    <message>
      <source>Folder for the pictures</source>
      <translation>Ordner für die Bilder</translation>
    </message>
    <message>
      <source>Writing {name} …</source>
      <translation>{name} wird geschrieben …</translation>
    </message>
    <message>
      <source>Drag to any frame</source>
      <translation>Zu jedem Bild ziehen</translation>
    </message>
    <message>
      <source>Frame (counted from 1)</source>
      <translation>Bild (ab 1 gezählt)</translation>
    </message>
    <message>
      <source>There and back</source>
      <translation>Hin und zurück</translation>
    </message>
    <message>
      <source>Once</source>
      <translation>Einmal</translation>
    </message>
    <message>
      <source>{count} pairs, median {median:.2f} px, states differ in {share:.1f} %</source>
      <translation>{count} Paare, Median {median:.2f} px, Zustände verschieden in {share:.1f} %</translation>
    </message>
    <message>
      <source>Follow through the scene</source>
      <translation>Durch die Szene verfolgen</translation>
    </message>
    <message>
      <source>Carries the points of the other set through the 4D scene, hidden or not</source>
      <translation>Trägt die Punkte der anderen Spuren durch die 4D-Szene, verdeckt oder nicht</translation>
    </message>
    <message>
      <source>predicted</source>
      <translation>vorhergesagt</translation>
    </message>
    <message>
      <source>imported</source>
      <translation>importiert</translation>
    </message>
    <message>
      <source>Tracks, or the scene of another run</source>
      <translation>Spuren oder die Szene eines anderen Laufs</translation>
    </message>
    <message>
      <source>px at 256</source>
      <translation>px bei 256</translation>
    </message>
    <message>
      <source>Tracks</source>
      <translation>Spuren</translation>
    </message>
    <message>
      <source>Origin</source>
      <translation>Herkunft</translation>
    </message>
    <message>
      <source>Worst frame</source>
      <translation>Schlechtestes Bild</translation>
    </message>
    <message>
      <source>Jump to worst</source>
      <translation>Zum schlechtesten</translation>
    </message>
    <message>
      <source>against</source>
      <translation>gegen</translation>
    </message>
    <message>
      <source>Its points have this mark, hollow where they are hidden; trails are dotted there.</source>
      <translation>Ihre Punkte haben dieses Zeichen, hohl, wo sie verdeckt sind; Spuren sind dort gepunktet.</translation>
    </message>
    <message>
      <source>Import tracks, or place points in the workspace Annotate.</source>
      <translation>Spuren einlesen oder im Bereich Annotieren Punkte setzen.</translation>
    </message>
    <message>
      <source>Of the clip</source>
      <translation>Des Clips</translation>
    </message>
    <message>
      <source>Map of directions</source>
      <translation>Karte der Richtungen</translation>
    </message>
    <message>
      <source>Every direction: green was supervised or is within {degrees:.0f}° of it, faint is a guess.
Points are supervised views, the ring is this view. Click, drag or use the arrow keys to turn.</source>
      <translation>Alle Richtungen: Grün wurde überwacht oder liegt höchstens {degrees:.0f}° davon entfernt, Blasses ist geraten.
Punkte sind überwachte Ansichten, der Ring ist diese Ansicht. Klicken, ziehen oder Pfeiltasten drehen.</translation>
    </message>
    <message>
      <source>The colour behind the scene</source>
      <translation>Die Farbe hinter der Szene</translation>
    </message>
    <message>
      <source>Azimuth</source>
      <translation>Azimut</translation>
    </message>
    <message>
      <source>Roll</source>
      <translation>Rollen</translation>
    </message>
    <message>
      <source>Radius</source>
      <translation>Abstand</translation>
    </message>
    <message>
      <source>Field of view</source>
      <translation>Bildwinkel</translation>
    </message>
    <message>
      <source>Splat size</source>
      <translation>Größe der Glocken</translation>
    </message>
    <message>
      <source>Behind it</source>
      <translation>Dahinter</translation>
    </message>
    <message>
      <source>Copies these numbers as text</source>
      <translation>Kopiert diese Zahlen als Text</translation>
    </message>
    <message>
      <source>As the theme</source>
      <translation>Wie das Farbschema</translation>
    </message>
    <message>
      <source>Black</source>
      <translation>Schwarz</translation>
    </message>
    <message>
      <source>White</source>
      <translation>Weiß</translation>
    </message>
    <message>
      <source>Another colour…</source>
      <translation>Andere Farbe …</translation>
    </message>
    <message>
      <source>Seen: supervision reaches this view.</source>
      <translation>Gesehen: die Überwachung reicht bis hierher.</translation>
    </message>
    <message>
      <source>Copy</source>
      <translation>Kopieren</translation>
    </message>
    <message>
      <source>Paste</source>
      <translation>Einfügen</translation>
    </message>
    <message>
      <source>New run</source>
      <translation>Neuer Lauf</translation>
    </message>
    <message>
      <source>This run</source>
      <translation>Dieser Lauf</translation>
    </message>
    <message>
      <source>clip</source>
      <translation>Clip</translation>
    </message>
    <message>
      <source>scene</source>
      <translation>Szene</translation>
    </message>
    <message>
      <source>project</source>
      <translation>Projekt</translation>
    </message>
    <message>
      <source>splat</source>
      <translation>Glocken</translation>
    </message>
    <message>
      <source>run</source>
      <translation>Lauf</translation>
    </message>
    <message>
      <source>From a video of several objects to a complete 4D scene and accurate point tracks.</source>
      <translation>Aus einem Video mehrerer Objekte wird eine vollständige 4D-Szene mit genauen Punktspuren.</translation>
    </message>
    <message>
      <source>Open the demo clip</source>
      <translation>Demo-Clip öffnen</translation>
    </message>
    <message>
      <source>Or drop a folder or a file anywhere on the window.  Ctrl+K finds every command, F1 every key.</source>
      <translation>Oder legen Sie einen Ordner oder eine Datei irgendwo auf dem Fenster ab.  Strg+K findet jeden Befehl, F1 jede Taste.</translation>
    </message>
    <message>
      <source>Opened lately</source>
      <translation>Zuletzt geöffnet</translation>
    </message>
    <message>
      <source>Try it</source>
      <translation>Ausprobieren</translation>
    </message>
    <message>
      <source>Shapes that cross and hide one another, made on the spot.</source>
      <translation>Körper, die sich kreuzen und verdecken, an Ort und Stelle erzeugt.</translation>
    </message>
    <message>
      <source>Your own clip</source>
      <translation>Ihr eigener Clip</translation>
    </message>
    <message>
      <source>A folder of images. Masks, depth and cameras beside it are used if they are there.</source>
      <translation>Ein Ordner mit Bildern. Masken, Tiefe und Kameras daneben werden benutzt, wenn es sie gibt.</translation>
    </message>
    <message>
      <source>A file</source>
      <translation>Eine Datei</translation>
    </message>
    <message>
      <source>A video, a scene (.h5), an annotation project (.genmojo) or a splat (.ply).</source>
      <translation>Ein Video, eine Szene (.h5), ein Annotationsprojekt (.genmojo) oder Glocken (.ply).</translation>
    </message>
    <message>
      <source>run, going on now</source>
      <translation>Lauf, gerade im Gang</translation>
    </message>
    <message>
      <source>Nothing yet.</source>
      <translation>Noch nichts.</translation>
    </message>
    <message>
      <source>Open clip folder…</source>
      <translation>Clip-Ordner öffnen…</translation>
    </message>
    <message>
      <source>Open file…</source>
      <translation>Datei öffnen…</translation>
    </message>
    <message>
      <source>Making the demo clip …</source>
      <translation>Der Demo-Clip wird erzeugt …</translation>
    </message>
    <message>
      <source>Open a clip folder</source>
      <translation>Clip-Ordner öffnen</translation>
    </message>
    <message>
      <source>Open a file</source>
      <translation>Datei öffnen</translation>
    </message>
    <message>
      <source>Reports of earlier crashes</source>
      <translation>Berichte früherer Abstürze</translation>
    </message>
    <message>
      <source>Loading …</source>
      <translation>Wird geladen …</translation>
    </message>
    <message>
      <source>The run was started by another version of the program (protocol {version}).</source>
      <translation>Der Lauf wurde von einer anderen Version des Programms gestartet (Protokoll {version}).</translation>
    </message>
    <message>
      <source>Correct this and start again.</source>
      <translation>Das berichtigen und neu starten.</translation>
    </message>
    <message>
      <source>This is a fault of the program; please report it with the details.</source>
      <translation>Das ist ein Fehler des Programms; bitte mit den Einzelheiten melden.</translation>
    </message>
    <message>
      <source>Close other programs, or choose a smaller size, fewer Gaussians per object or the draft preset.</source>
      <translation>Andere Programme schließen, oder eine kleinere Größe, weniger Gaußglocken je Objekt oder die Voreinstellung Entwurf wählen.</translation>
    </message>
    <message>
      <source>Another program or the system ended it; if nobody did so on purpose, memory may have run out.</source>
      <translation>Ein anderes Programm oder das System hat sie beendet; wenn das niemand wollte, ging vielleicht der Speicher aus.</translation>
    </message>
    <message>
      <source>This is a fault in compiled code; please report it with the details.</source>
      <translation>Das ist ein Fehler in übersetztem Code; bitte mit den Einzelheiten melden.</translation>
    </message>
    <message>
      <source>Wait if the machine was asleep or very busy; else end it and resume from the last checkpoint.</source>
      <translation>Warten, wenn der Rechner schlief oder sehr beschäftigt war; sonst beenden und vom letzten Prüfpunkt fortsetzen.</translation>
    </message>
    <message>
      <source>Look at the details; reinstalling the program may help.</source>
      <translation>Die Einzelheiten ansehen; das Programm neu zu installieren kann helfen.</translation>
    </message>
    <message>
      <source>Let the run finish or end it, then start it again with this version of the program.</source>
      <translation>Den Lauf zu Ende gehen lassen oder beenden und mit dieser Version des Programms neu starten.</translation>
    </message>
    <message>
      <source>The optimiser has not answered for {seconds:.0f} s.</source>
      <translation>Die Optimierung antwortet seit {seconds:.0f} s nicht.</translation>
    </message>
    <message>
      <source>The optimiser has not answered for {seconds:.0f} s while {phase}.</source>
      <translation>Die Optimierung antwortet seit {seconds:.0f} s nicht ({phase}).</translation>
    </message>
    <message>
      <source>an access violation</source>
      <translation>unerlaubter Speicherzugriff</translation>
    </message>
    <message>
      <source>The optimiser ended with exit code {code}.</source>
      <translation>Die Optimierung endete mit Code {code}.</translation>
    </message>
    <message>
      <source>The run can be resumed from its last checkpoint.</source>
      <translation>Der Lauf kann von seinem letzten Prüfpunkt fortgesetzt werden.</translation>
    </message>
    <message>
      <source>The optimiser crashed in compiled code ({name}).</source>
      <translation>Die Optimierung ist in übersetztem Code abgestürzt ({name}).</translation>
    </message>
    <message>
      <source>The system ended the optimiser when memory ran out; it used {gb:.1f} GB.</source>
      <translation>Das System hat die Optimierung beendet, als der Speicher ausging; sie brauchte {gb:.1f} GB.</translation>
    </message>
    <message>
      <source>The optimiser was ended from outside by {name}.</source>
      <translation>Die Optimierung wurde von außen durch {name} beendet.</translation>
    </message>
    <message>
      <source>The optimiser was ended from outside.</source>
      <translation>Die Optimierung wurde von außen beendet.</translation>
    </message>
    <message>
      <source>The optimiser could not start (exit code {code}).</source>
      <translation>Die Optimierung konnte nicht starten (Code {code}).</translation>
    </message>
    <message>
      <source>Opens a folder of images or a clip.</source>
      <translation>Öffnet einen Ordner mit Bildern oder einen Clip.</translation>
    </message>
    <message>
      <source>Opens a video, a scene, a project or a PLY.</source>
      <translation>Öffnet ein Video, eine Szene, ein Projekt oder eine PLY-Datei.</translation>
    </message>
    <message>
      <source>Makes a small clip on the spot and opens it.</source>
      <translation>Erzeugt einen kleinen Clip und öffnet ihn.</translation>
    </message>
    <message>
      <source>Back to the start page</source>
      <translation>Zurück zur Startseite</translation>
    </message>
    <message>
      <source>Keeps everything open.</source>
      <translation>Alles bleibt offen.</translation>
    </message>
    <message>
      <source>Shortcuts and settings…</source>
      <translation>Tasten und Einstellungen…</translation>
    </message>
    <message>
      <source>Keys, language.</source>
      <translation>Tasten, Sprache.</translation>
    </message>
    <message>
      <source>Quit</source>
      <translation>Beenden</translation>
    </message>
    <message>
      <source>Closes the window; nothing is lost.</source>
      <translation>Schließt das Fenster; nichts geht verloren.</translation>
    </message>
    <message>
      <source>Points and masks by hand.</source>
      <translation>Punkte und Masken von Hand.</translation>
    </message>
    <message>
      <source>Window</source>
      <translation>Fenster</translation>
    </message>
    <message>
      <source>Optimise, look at and compare scenes.</source>
      <translation>Optimieren, Szenen ansehen und vergleichen.</translation>
    </message>
    <message>
      <source>Light theme</source>
      <translation>Helles Aussehen</translation>
    </message>
    <message>
      <source>Switches between the dark and the light theme.</source>
      <translation>Wechselt zwischen dunklem und hellem Aussehen.</translation>
    </message>
    <message>
      <source>Pictures only</source>
      <translation>Nur Bilder</translation>
    </message>
    <message>
      <source>Hides all panels, so that the pictures fill the window; again brings them back.</source>
      <translation>Blendet alle Bereiche aus, damit die Bilder das Fenster füllen; noch einmal bringt sie zurück.</translation>
    </message>
    <message>
      <source>Full screen</source>
      <translation>Vollbild</translation>
    </message>
    <message>
      <source>Fills the screen.</source>
      <translation>Füllt den Bildschirm.</translation>
    </message>
    <message>
      <source>Reset the panels</source>
      <translation>Bereiche zurücksetzen</translation>
    </message>
    <message>
      <source>Puts every panel where it was delivered.</source>
      <translation>Stellt jeden Bereich, wie er geliefert wurde.</translation>
    </message>
    <message>
      <source>Find a command…</source>
      <translation>Befehl suchen…</translation>
    </message>
    <message>
      <source>Type what you want to do.</source>
      <translation>Schreiben Sie, was Sie tun möchten.</translation>
    </message>
    <message>
      <source>Help</source>
      <translation>Hilfe</translation>
    </message>
    <message>
      <source>Shows the keys that work here.</source>
      <translation>Zeigt die Tasten, die hier gelten.</translation>
    </message>
    <message>
      <source>Try hard cases on this machine…</source>
      <translation>Harte Fälle auf diesem Rechner versuchen…</translation>
    </message>
    <message>
      <source>Hostile splats, masks, depths and numbers that go bad, with a verdict each; some minutes.</source>
      <translation>Feindliche Splats, Masken, Tiefen und Zahlen, die entgleisen, jeweils mit Urteil; einige Minuten.</translation>
    </message>
    <message>
      <source>What faults left behind.</source>
      <translation>Was Fehler hinterlassen haben.</translation>
    </message>
    <message>
      <source>Version, licences of what is inside.</source>
      <translation>Version, Lizenzen der Bestandteile.</translation>
    </message>
    <message>
      <source>Undo</source>
      <translation>Rückgängig</translation>
    </message>
    <message>
      <source>Takes the last change of the view or the scene back.</source>
      <translation>Nimmt die letzte Änderung der Ansicht oder Szene zurück.</translation>
    </message>
    <message>
      <source>Edit</source>
      <translation>Bearbeiten</translation>
    </message>
    <message>
      <source>Redo</source>
      <translation>Wiederholen</translation>
    </message>
    <message>
      <source>Does it again.</source>
      <translation>Tut es noch einmal.</translation>
    </message>
    <message>
      <source>Input camera</source>
      <translation>Eingabekamera</translation>
    </message>
    <message>
      <source>View</source>
      <translation>Ansicht</translation>
    </message>
    <message>
      <source>Direction</source>
      <translation>Richtung</translation>
    </message>
    <message>
      <source>30° to the right</source>
      <translation>30° nach rechts</translation>
    </message>
    <message>
      <source>30° to the left</source>
      <translation>30° nach links</translation>
    </message>
    <message>
      <source>30° from above</source>
      <translation>30° von oben</translation>
    </message>
    <message>
      <source>30° from below</source>
      <translation>30° von unten</translation>
    </message>
    <message>
      <source>90° to the right</source>
      <translation>90° nach rechts</translation>
    </message>
    <message>
      <source>90° to the left</source>
      <translation>90° nach links</translation>
    </message>
    <message>
      <source>From behind</source>
      <translation>Von hinten</translation>
    </message>
    <message>
      <source>From the top</source>
      <translation>Von oben</translation>
    </message>
    <message>
      <source>Objects, mixed</source>
      <translation>Objekte, gemischt</translation>
    </message>
    <message>
      <source>Depth, median</source>
      <translation>Tiefe, Median</translation>
    </message>
    <message>
      <source>Error against the input</source>
      <translation>Fehler zur Eingabe</translation>
    </message>
    <message>
      <source>Ellipsoids</source>
      <translation>Ellipsoide</translation>
    </message>
    <message>
      <source>Centres</source>
      <translation>Mittelpunkte</translation>
    </message>
    <message>
      <source>Scene alone</source>
      <translation>Nur die Szene</translation>
    </message>
    <message>
      <source>Compare with the input</source>
      <translation>Mit der Eingabe vergleichen</translation>
    </message>
    <message>
      <source>Input beside it</source>
      <translation>Eingabe daneben</translation>
    </message>
    <message>
      <source>Onion skin</source>
      <translation>Zwiebelhaut</translation>
    </message>
    <message>
      <source>Shows or leaves out the background.</source>
      <translation>Zeigt den Hintergrund oder lässt ihn weg.</translation>
    </message>
    <message>
      <source>Every object in the shape it was reconstructed in.</source>
      <translation>Jedes Objekt in der Form, in der es rekonstruiert wurde.</translation>
    </message>
    <message>
      <source>Draws tracks over both pictures.</source>
      <translation>Zeichnet Spuren über beide Bilder.</translation>
    </message>
    <message>
      <source>Ends solo, hiding, tints and explosion.</source>
      <translation>Beendet Alleinzeigen, Verbergen, Färben und Abstand.</translation>
    </message>
    <message>
      <source>Solo the selected object</source>
      <translation>Gewähltes Objekt allein</translation>
    </message>
    <message>
      <source>Hides everything else.</source>
      <translation>Verbirgt alles andere.</translation>
    </message>
    <message>
      <source>Goes to the annotator's step Objects.</source>
      <translation>Geht zum Schritt Objekte des Annotators.</translation>
    </message>
    <message>
      <source>Run</source>
      <translation>Lauf</translation>
    </message>
    <message>
      <source>Curves</source>
      <translation>Kurven</translation>
    </message>
    <message>
      <source>Picked Gaussian</source>
      <translation>Gewählte Gaußglocke</translation>
    </message>
    <message>
      <source>Compare scenes</source>
      <translation>Szenen vergleichen</translation>
    </message>
    <message>
      <source>Play or pause</source>
      <translation>Abspielen oder anhalten</translation>
    </message>
    <message>
      <source>Lets time run.</source>
      <translation>Lässt die Zeit laufen.</translation>
    </message>
    <message>
      <source>Next frame</source>
      <translation>Nächstes Bild</translation>
    </message>
    <message>
      <source>Previous frame</source>
      <translation>Voriges Bild</translation>
    </message>
    <message>
      <source>First frame</source>
      <translation>Erstes Bild</translation>
    </message>
    <message>
      <source>Last frame</source>
      <translation>Letztes Bild</translation>
    </message>
    <message>
      <source>Faster</source>
      <translation>Schneller</translation>
    </message>
    <message>
      <source>Slower</source>
      <translation>Langsamer</translation>
    </message>
    <message>
      <source>Start a run</source>
      <translation>Lauf starten</translation>
    </message>
    <message>
      <source>Optimises a scene of the open clip.</source>
      <translation>Optimiert eine Szene des offenen Clips.</translation>
    </message>
    <message>
      <source>Pause or go on</source>
      <translation>Anhalten oder weiter</translation>
    </message>
    <message>
      <source>One step</source>
      <translation>Ein Schritt</translation>
    </message>
    <message>
      <source>While paused.</source>
      <translation>Solange angehalten ist.</translation>
    </message>
    <message>
      <source>Run to the next stage</source>
      <translation>Bis zur nächsten Stufe</translation>
    </message>
    <message>
      <source>Write a checkpoint</source>
      <translation>Prüfpunkt schreiben</translation>
    </message>
    <message>
      <source>Stop and throw it away…</source>
      <translation>Beenden und verwerfen…</translation>
    </message>
    <message>
      <source>Save the curves as CSV…</source>
      <translation>Kurven als CSV speichern…</translation>
    </message>
    <message>
      <source>Go on with a run folder…</source>
      <translation>Mit einem Lauf-Ordner weitermachen…</translation>
    </message>
    <message>
      <source>Shows a run that lives, or resumes its checkpoint.</source>
      <translation>Zeigt einen lebenden Lauf oder setzt seinen Prüfpunkt fort.</translation>
    </message>
    <message>
      <source>Scene as HDF5…</source>
      <translation>Szene als HDF5…</translation>
    </message>
    <message>
      <source>Take away</source>
      <translation>Mitnehmen</translation>
    </message>
    <message>
      <source>This frame as PLY…</source>
      <translation>Dieses Bild als PLY…</translation>
    </message>
    <message>
      <source>All frames as PLY…</source>
      <translation>Alle Bilder als PLY…</translation>
    </message>
    <message>
      <source>Picture of this view…</source>
      <translation>Bild dieser Ansicht…</translation>
    </message>
    <message>
      <source>Turntable video…</source>
      <translation>Drehtisch-Video…</translation>
    </message>
    <message>
      <source>Camera path…</source>
      <translation>Kamerafahrt…</translation>
    </message>
    <message>
      <source>Keys with pose, lens and scene time; renders a video.</source>
      <translation>Schlüssel mit Lage, Linse und Zeit der Szene; ergibt ein Video.</translation>
    </message>
    <message>
      <source>One frame on.</source>
      <translation>Ein Bild weiter.</translation>
    </message>
    <message>
      <source>Go</source>
      <translation>Gehen</translation>
    </message>
    <message>
      <source>One frame back.</source>
      <translation>Ein Bild zurück.</translation>
    </message>
    <message>
      <source>On by the stride</source>
      <translation>Um die Schrittweite weiter</translation>
    </message>
    <message>
      <source>On by the frames of the stride.</source>
      <translation>Um die Bilder der Schrittweite weiter.</translation>
    </message>
    <message>
      <source>Back by the stride</source>
      <translation>Um die Schrittweite zurück</translation>
    </message>
    <message>
      <source>Back by the stride.</source>
      <translation>Um die Schrittweite zurück.</translation>
    </message>
    <message>
      <source>Accept all points and go on</source>
      <translation>Alle Punkte annehmen und weiter</translation>
    </message>
    <message>
      <source>Confirms the points here that nothing speaks against, and goes on by the stride or to the point that needs a look.</source>
      <translation>Bestätigt die Punkte hier, gegen die nichts spricht, und geht um die Schrittweite weiter oder zum Punkt, der einen Blick braucht.</translation>
    </message>
    <message>
      <source>Accept and go back</source>
      <translation>Annehmen und zurück</translation>
    </message>
    <message>
      <source>The same, backwards.</source>
      <translation>Dasselbe rückwärts.</translation>
    </message>
    <message>
      <source>Ten frames on</source>
      <translation>Zehn Bilder weiter</translation>
    </message>
    <message>
      <source>Ten frames on.</source>
      <translation>Zehn Bilder weiter.</translation>
    </message>
    <message>
      <source>Ten frames back</source>
      <translation>Zehn Bilder zurück</translation>
    </message>
    <message>
      <source>Ten back.</source>
      <translation>Zehn zurück.</translation>
    </message>
    <message>
      <source>A hundred frames on</source>
      <translation>Hundert Bilder weiter</translation>
    </message>
    <message>
      <source>A hundred frames on.</source>
      <translation>Hundert Bilder weiter.</translation>
    </message>
    <message>
      <source>A hundred frames back</source>
      <translation>Hundert Bilder zurück</translation>
    </message>
    <message>
      <source>A hundred frames back.</source>
      <translation>Hundert Bilder zurück.</translation>
    </message>
    <message>
      <source>The clip's first frame.</source>
      <translation>Das erste Bild des Clips.</translation>
    </message>
    <message>
      <source>The clip's last frame.</source>
      <translation>Das letzte Bild des Clips.</translation>
    </message>
    <message>
      <source>Plays at the speed chosen.</source>
      <translation>Spielt im gewählten Tempo.</translation>
    </message>
    <message>
      <source>Play the segment in a loop</source>
      <translation>Abschnitt in Schleife spielen</translation>
    </message>
    <message>
      <source>Between the keys around this frame.</source>
      <translation>Zwischen den Schlüsseln um dieses Bild.</translation>
    </message>
    <message>
      <source>Next key of the track</source>
      <translation>Nächster Schlüssel der Spur</translation>
    </message>
    <message>
      <source>Where a person placed the point next.</source>
      <translation>Wo ein Mensch den Punkt als Nächstes gesetzt hat.</translation>
    </message>
    <message>
      <source>Previous key of the track</source>
      <translation>Voriger Schlüssel der Spur</translation>
    </message>
    <message>
      <source>The key before.</source>
      <translation>Der Schlüssel davor.</translation>
    </message>
    <message>
      <source>Middle of the gap</source>
      <translation>Mitte der Lücke</translation>
    </message>
    <message>
      <source>The frame halfway between the keys around this one.</source>
      <translation>Das Bild mitten zwischen den Schlüsseln um dieses.</translation>
    </message>
    <message>
      <source>Next suspicious spot</source>
      <translation>Nächste verdächtige Stelle</translation>
    </message>
    <message>
      <source>The most suspicious spot that nobody looked at.</source>
      <translation>Die verdächtigste Stelle, die niemand angesehen hat.</translation>
    </message>
    <message>
      <source>Previous suspicious spot</source>
      <translation>Vorige verdächtige Stelle</translation>
    </message>
    <message>
      <source>Back through the suspicious spots.</source>
      <translation>Zurück durch die verdächtigen Stellen.</translation>
    </message>
    <message>
      <source>Back to where I was</source>
      <translation>Dorthin zurück, wo ich war</translation>
    </message>
    <message>
      <source>The frame and track before the last jump.</source>
      <translation>Bild und Spur vor dem letzten Sprung.</translation>
    </message>
    <message>
      <source>Next panel</source>
      <translation>Nächster Bereich</translation>
    </message>
    <message>
      <source>Moves the keyboard to the next panel.</source>
      <translation>Setzt die Tastatur in den nächsten Bereich.</translation>
    </message>
    <message>
      <source>Previous panel</source>
      <translation>Voriges Fenster</translation>
    </message>
    <message>
      <source>Moves the keyboard to the panel before.</source>
      <translation>Gibt die Tastatur dem Fenster davor.</translation>
    </message>
    <message>
      <source>Back to the frame</source>
      <translation>Zurück zum Bild</translation>
    </message>
    <message>
      <source>Gives the keyboard to the frame and puts drawing tools away.</source>
      <translation>Gibt die Tastatur dem Bild und legt Zeichenwerkzeuge weg.</translation>
    </message>
    <message>
      <source>Point 1</source>
      <translation>Punkt 1</translation>
    </message>
    <message>
      <source>Point 1 of the object is active.</source>
      <translation>Punkt 1 des Objekts ist aktiv.</translation>
    </message>
    <message>
      <source>Point 2</source>
      <translation>Punkt 2</translation>
    </message>
    <message>
      <source>Point 2 of the object is active.</source>
      <translation>Punkt 2 des Objekts ist aktiv.</translation>
    </message>
    <message>
      <source>Point 3</source>
      <translation>Punkt 3</translation>
    </message>
    <message>
      <source>Point 3 of the object is active.</source>
      <translation>Punkt 3 des Objekts ist aktiv.</translation>
    </message>
    <message>
      <source>Point 4</source>
      <translation>Punkt 4</translation>
    </message>
    <message>
      <source>Point 4 of the object is active.</source>
      <translation>Punkt 4 des Objekts ist aktiv.</translation>
    </message>
    <message>
      <source>Point 5</source>
      <translation>Punkt 5</translation>
    </message>
    <message>
      <source>Point 5 of the object is active.</source>
      <translation>Punkt 5 des Objekts ist aktiv.</translation>
    </message>
    <message>
      <source>Point 6</source>
      <translation>Punkt 6</translation>
    </message>
    <message>
      <source>Point 6 of the object is active.</source>
      <translation>Punkt 6 des Objekts ist aktiv.</translation>
    </message>
    <message>
      <source>Point 7</source>
      <translation>Punkt 7</translation>
    </message>
    <message>
      <source>Point 7 of the object is active.</source>
      <translation>Punkt 7 des Objekts ist aktiv.</translation>
    </message>
    <message>
      <source>Point 8</source>
      <translation>Punkt 8</translation>
    </message>
    <message>
      <source>Point 8 of the object is active.</source>
      <translation>Punkt 8 des Objekts ist aktiv.</translation>
    </message>
    <message>
      <source>Point 9</source>
      <translation>Punkt 9</translation>
    </message>
    <message>
      <source>Point 9 of the object is active.</source>
      <translation>Punkt 9 des Objekts ist aktiv.</translation>
    </message>
    <message>
      <source>Object 1</source>
      <translation>Objekt 1</translation>
    </message>
    <message>
      <source>Makes object 1 active.</source>
      <translation>Macht Objekt 1 aktiv.</translation>
    </message>
    <message>
      <source>Object 2</source>
      <translation>Objekt 2</translation>
    </message>
    <message>
      <source>Makes object 2 active.</source>
      <translation>Macht Objekt 2 aktiv.</translation>
    </message>
    <message>
      <source>Object 3</source>
      <translation>Objekt 3</translation>
    </message>
    <message>
      <source>Makes object 3 active.</source>
      <translation>Macht Objekt 3 aktiv.</translation>
    </message>
    <message>
      <source>Object 4</source>
      <translation>Objekt 4</translation>
    </message>
    <message>
      <source>Makes object 4 active.</source>
      <translation>Macht Objekt 4 aktiv.</translation>
    </message>
    <message>
      <source>Object 5</source>
      <translation>Objekt 5</translation>
    </message>
    <message>
      <source>Makes object 5 active.</source>
      <translation>Macht Objekt 5 aktiv.</translation>
    </message>
    <message>
      <source>Object 6</source>
      <translation>Objekt 6</translation>
    </message>
    <message>
      <source>Makes object 6 active.</source>
      <translation>Macht Objekt 6 aktiv.</translation>
    </message>
    <message>
      <source>Object 7</source>
      <translation>Objekt 7</translation>
    </message>
    <message>
      <source>Makes object 7 active.</source>
      <translation>Macht Objekt 7 aktiv.</translation>
    </message>
    <message>
      <source>Object 8</source>
      <translation>Objekt 8</translation>
    </message>
    <message>
      <source>Makes object 8 active.</source>
      <translation>Macht Objekt 8 aktiv.</translation>
    </message>
    <message>
      <source>Object 9</source>
      <translation>Objekt 9</translation>
    </message>
    <message>
      <source>Makes object 9 active.</source>
      <translation>Macht Objekt 9 aktiv.</translation>
    </message>
    <message>
      <source>Next point</source>
      <translation>Nächster Punkt</translation>
    </message>
    <message>
      <source>The next point; in the frame Tab does it too.</source>
      <translation>Der nächste Punkt; im Bild auch mit Tab.</translation>
    </message>
    <message>
      <source>Previous point</source>
      <translation>Voriger Punkt</translation>
    </message>
    <message>
      <source>The point before; in the frame Shift+Tab too.</source>
      <translation>Der Punkt davor; im Bild auch mit Umschalt+Tab.</translation>
    </message>
    <message>
      <source>Occluded</source>
      <translation>Verdeckt</translation>
    </message>
    <message>
      <source>Hidden by something; hold and step to paint. Right click too.</source>
      <translation>Von etwas verdeckt; halten und weitergehen malt. Auch Rechtsklick.</translation>
    </message>
    <message>
      <source>Outside the picture; hold and step to paint.</source>
      <translation>Außerhalb des Bilds; halten und weitergehen malt.</translation>
    </message>
    <message>
      <source>Visible</source>
      <translation>Sichtbar</translation>
    </message>
    <message>
      <source>Seen; hold and step to paint.</source>
      <translation>Zu sehen; halten und weitergehen malt.</translation>
    </message>
    <message>
      <source>Uncertain</source>
      <translation>Unsicher</translation>
    </message>
    <message>
      <source>Marks a place as uncertain, or no longer.</source>
      <translation>Kennzeichnet eine Stelle als unsicher oder nicht mehr.</translation>
    </message>
    <message>
      <source>Run starts here</source>
      <translation>Strecke beginnt hier</translation>
    </message>
    <message>
      <source>The next state, or fault found, begins in this frame.</source>
      <translation>Der nächste Zustand oder gefundene Fehler beginnt in diesem Bild.</translation>
    </message>
    <message>
      <source>Run ends here</source>
      <translation>Strecke endet hier</translation>
    </message>
    <message>
      <source>The next state, or fault found, ends in this frame.</source>
      <translation>Der nächste Zustand oder gefundene Fehler endet in diesem Bild.</translation>
    </message>
    <message>
      <source>Key on or off</source>
      <translation>Schlüssel an oder aus</translation>
    </message>
    <message>
      <source>Makes this place a key, or an ordinary place.</source>
      <translation>Macht diese Stelle zum Schlüssel oder zu einer gewöhnlichen Stelle.</translation>
    </message>
    <message>
      <source>Delete the key</source>
      <translation>Schlüssel löschen</translation>
    </message>
    <message>
      <source>The key becomes an ordinary place.</source>
      <translation>Der Schlüssel wird eine gewöhnliche Stelle.</translation>
    </message>
    <message>
      <source>Snap to the likeness</source>
      <translation>Auf die Ähnlichkeit einrasten</translation>
    </message>
    <message>
      <source>Clicks go to the best likeness nearby, on a point's first key to the nearest corner; shown before.</source>
      <translation>Klicks gehen zur ähnlichsten Stelle in der Nähe, beim ersten Schlüssel eines Punkts zur nächsten Ecke; sie wird vorher gezeigt.</translation>
    </message>
    <message>
      <source>Nudge left</source>
      <translation>Wenig nach links</translation>
    </message>
    <message>
      <source>A quarter of a pixel.</source>
      <translation>Ein viertel Pixel.</translation>
    </message>
    <message>
      <source>Nudge right</source>
      <translation>Wenig nach rechts</translation>
    </message>
    <message>
      <source>Nudge up</source>
      <translation>Wenig nach oben</translation>
    </message>
    <message>
      <source>Nudge down</source>
      <translation>Wenig nach unten</translation>
    </message>
    <message>
      <source>Push left</source>
      <translation>Nach links</translation>
    </message>
    <message>
      <source>One pixel.</source>
      <translation>Ein Pixel.</translation>
    </message>
    <message>
      <source>Push right</source>
      <translation>Nach rechts</translation>
    </message>
    <message>
      <source>Push up</source>
      <translation>Nach oben</translation>
    </message>
    <message>
      <source>Push down</source>
      <translation>Nach unten</translation>
    </message>
    <message>
      <source>Lets a tracker propose positions for every point.</source>
      <translation>Lässt einen Verfolger Stellen für jeden Punkt vorschlagen.</translation>
    </message>
    <message>
      <source>Track one frame on</source>
      <translation>Ein Bild weiter verfolgen</translation>
    </message>
    <message>
      <source>Takes the point into the next frame.</source>
      <translation>Nimmt den Punkt in das nächste Bild mit.</translation>
    </message>
    <message>
      <source>Track one frame back</source>
      <translation>Ein Bild zurück verfolgen</translation>
    </message>
    <message>
      <source>Takes the point into the frame before.</source>
      <translation>Nimmt den Punkt in das Bild davor mit.</translation>
    </message>
    <message>
      <source>Track on to the end</source>
      <translation>Bis zum Ende verfolgen</translation>
    </message>
    <message>
      <source>Solves from here to the next key.</source>
      <translation>Löst von hier bis zum nächsten Schlüssel.</translation>
    </message>
    <message>
      <source>Track back to the start</source>
      <translation>Bis zum Anfang verfolgen</translation>
    </message>
    <message>
      <source>Solves back to the key before.</source>
      <translation>Löst zurück bis zum Schlüssel davor.</translation>
    </message>
    <message>
      <source>Solve the segment again</source>
      <translation>Abschnitt neu lösen</translation>
    </message>
    <message>
      <source>Segment: tracker, line, hold</source>
      <translation>Abschnitt: Verfolger, Gerade, gehalten</translation>
    </message>
    <message>
      <source>How the segment between two keys is filled.</source>
      <translation>Wie der Abschnitt zwischen zwei Schlüsseln gefüllt wird.</translation>
    </message>
    <message>
      <source>Clear after this frame</source>
      <translation>Nach diesem Bild leeren</translation>
    </message>
    <message>
      <source>Forgets the track after here.</source>
      <translation>Vergisst die Spur ab hier.</translation>
    </message>
    <message>
      <source>Clear before this frame</source>
      <translation>Vor diesem Bild leeren</translation>
    </message>
    <message>
      <source>Forgets it before here.</source>
      <translation>Vergisst sie bis hier.</translation>
    </message>
    <message>
      <source>Swap with another point…</source>
      <translation>Mit einem anderen Punkt tauschen…</translation>
    </message>
    <message>
      <source>Two points change places from here on.</source>
      <translation>Zwei Punkte tauschen ab hier den Platz.</translation>
    </message>
    <message>
      <source>Lock the track</source>
      <translation>Spur sperren</translation>
    </message>
    <message>
      <source>A locked track cannot be changed.</source>
      <translation>Eine gesperrte Spur lässt sich nicht ändern.</translation>
    </message>
    <message>
      <source>Delete the track</source>
      <translation>Spur löschen</translation>
    </message>
    <message>
      <source>Can be undone.</source>
      <translation>Lässt sich rückgängig machen.</translation>
    </message>
    <message>
      <source>Fit the frame</source>
      <translation>Bild einpassen</translation>
    </message>
    <message>
      <source>The whole frame.</source>
      <translation>Das ganze Bild.</translation>
    </message>
    <message>
      <source>One to one</source>
      <translation>Eins zu eins</translation>
    </message>
    <message>
      <source>One pixel of the clip per pixel of the screen.</source>
      <translation>Ein Pixel des Clips je Pixel des Bildschirms.</translation>
    </message>
    <message>
      <source>Zoom in</source>
      <translation>Vergrößern</translation>
    </message>
    <message>
      <source>About the middle of the frame.</source>
      <translation>Um die Mitte des Bilds.</translation>
    </message>
    <message>
      <source>Zoom out</source>
      <translation>Verkleinern</translation>
    </message>
    <message>
      <source>View follows the point</source>
      <translation>Ansicht folgt dem Punkt</translation>
    </message>
    <message>
      <source>Keeps the point in the middle.</source>
      <translation>Hält den Punkt in der Mitte.</translation>
    </message>
    <message>
      <source>Loupe while held</source>
      <translation>Lupe, solange gehalten</translation>
    </message>
    <message>
      <source>Now, the key before, the first frame and the difference.</source>
      <translation>Jetzt, voriger Schlüssel, erstes Bild und Differenz.</translation>
    </message>
    <message>
      <source>Keeps the loupe open.</source>
      <translation>Lässt die Lupe offen.</translation>
    </message>
    <message>
      <source>Smooth loupe</source>
      <translation>Glatte Lupe</translation>
    </message>
    <message>
      <source>Pixels melt into each other, or show as squares.</source>
      <translation>Pixel gehen ineinander über oder sind Quadrate.</translation>
    </message>
    <message>
      <source>Hide what is drawn while held</source>
      <translation>Gezeichnetes verbergen, solange gehalten</translation>
    </message>
    <message>
      <source>Shows the bare frame.</source>
      <translation>Zeigt das bloße Bild.</translation>
    </message>
    <message>
      <source>Masks: off, outline, filled</source>
      <translation>Masken: aus, Umriss, gefüllt</translation>
    </message>
    <message>
      <source>Changes how masks are drawn.</source>
      <translation>Ändert, wie Masken gezeichnet werden.</translation>
    </message>
    <message>
      <source>Trails: off, short, long</source>
      <translation>Schweife: aus, kurz, lang</translation>
    </message>
    <message>
      <source>Changes the length of the trails.</source>
      <translation>Ändert die Länge der Schweife.</translation>
    </message>
    <message>
      <source>Stabilised strip</source>
      <translation>Stabilisierter Streifen</translation>
    </message>
    <message>
      <source>Patches of the point in the frames around.</source>
      <translation>Ausschnitte um den Punkt in den Bildern ringsum.</translation>
    </message>
    <message>
      <source>Larger reticle</source>
      <translation>Größeres Fadenkreuz</translation>
    </message>
    <message>
      <source>The cross at the mouse.</source>
      <translation>Das Kreuz an der Maus.</translation>
    </message>
    <message>
      <source>Smaller reticle</source>
      <translation>Kleineres Fadenkreuz</translation>
    </message>
    <message>
      <source>Takes the last change back and shows where it was.</source>
      <translation>Nimmt die letzte Änderung zurück und zeigt, wo sie war.</translation>
    </message>
    <message>
      <source>Name this moment…</source>
      <translation>Diesen Stand benennen…</translation>
    </message>
    <message>
      <source>Everything is stored already; this gives it a name.</source>
      <translation>Alles ist schon gespeichert; so bekommt es einen Namen.</translation>
    </message>
    <message>
      <source>Go back to a named moment…</source>
      <translation>Zurück zu einem benannten Stand…</translation>
    </message>
    <message>
      <source>Undoes or redoes up to a checkpoint.</source>
      <translation>Nimmt zurück oder wiederholt bis zu einem Stand.</translation>
    </message>
    <message>
      <source>Needs a fix…</source>
      <translation>Nacharbeit nötig…</translation>
    </message>
    <message>
      <source>Returns the track to its annotator with a reason.</source>
      <translation>Gibt die Spur mit einem Grund an ihren Annotator zurück.</translation>
    </message>
    <message>
      <source>Fixed</source>
      <translation>Behoben</translation>
    </message>
    <message>
      <source>Says that the spot was worked on.</source>
      <translation>Sagt, dass an der Stelle gearbeitet wurde.</translation>
    </message>
    <message>
      <source>Approve the track</source>
      <translation>Spur freigeben</translation>
    </message>
    <message>
      <source>The track is right; it is locked.</source>
      <translation>Die Spur stimmt; sie wird gesperrt.</translation>
    </message>
    <message>
      <source>Reject the track</source>
      <translation>Spur verwerfen</translation>
    </message>
    <message>
      <source>Compare with a second annotator…</source>
      <translation>Mit einem zweiten Annotator vergleichen…</translation>
    </message>
    <message>
      <source>Agreement, and a merge with preview.</source>
      <translation>Übereinstimmung und Zusammenführen mit Vorschau.</translation>
    </message>
    <message>
      <source>Log and statistics…</source>
      <translation>Protokoll und Statistik…</translation>
    </message>
    <message>
      <source>Who did what when; time per clip and person.</source>
      <translation>Wer wann was getan hat; Zeit je Clip und Person.</translation>
    </message>
    <message>
      <source>Annotate a clip…</source>
      <translation>Clip annotieren…</translation>
    </message>
    <message>
      <source>Opens a clip with a project of its own.</source>
      <translation>Öffnet einen Clip mit eigenem Projekt.</translation>
    </message>
    <message>
      <source>Import tracks…</source>
      <translation>Spuren importieren…</translation>
    </message>
    <message>
      <source>TAP-Vid, CoTracker, SLEAP, DeepLabCut, CVAT, COCO, ours.</source>
      <translation>TAP-Vid, CoTracker, SLEAP, DeepLabCut, CVAT, COCO, unser Format.</translation>
    </message>
    <message>
      <source>Export tracks…</source>
      <translation>Spuren exportieren…</translation>
    </message>
    <message>
      <source>The same formats.</source>
      <translation>Dieselben Formate.</translation>
    </message>
    <message>
      <source>Tour of the annotator</source>
      <translation>Rundgang durch den Annotator</translation>
    </message>
    <message>
      <source>Ten steps on a clip made on the spot.</source>
      <translation>Zehn Schritte an einem Clip, der an Ort und Stelle entsteht.</translation>
    </message>
    <message>
      <source>Draw the selected mask anew</source>
      <translation>Gewählte Maske neu zeichnen</translation>
    </message>
    <message>
      <source>Step 1; what is drawn replaces the object's mask.</source>
      <translation>Schritt 1; was gezeichnet wird, ersetzt die Maske des Objekts.</translation>
    </message>
    <message>
      <source>Buttons</source>
      <translation>Knöpfe</translation>
    </message>
    <message>
      <source>Shows or hides this panel.</source>
      <translation>Zeigt oder verbirgt dieses Fenster.</translation>
    </message>
    <message>
      <source>Video play</source>
      <translation>Wiedergabe</translation>
    </message>
    <message>
      <source>Step 1 of 4.</source>
      <translation>Schritt 1 von 4.</translation>
    </message>
    <message>
      <source>Step 2 of 4.</source>
      <translation>Schritt 2 von 4.</translation>
    </message>
    <message>
      <source>Step 3 of 4.</source>
      <translation>Schritt 3 von 4.</translation>
    </message>
    <message>
      <source>Step 4 of 4.</source>
      <translation>Schritt 4 von 4.</translation>
    </message>
    <message>
      <source>given</source>
      <translation>gegeben</translation>
    </message>
    <message>
      <source>estimated</source>
      <translation>geschätzt</translation>
    </message>
    <message>
      <source>Switched on by the user.</source>
      <translation>Von Hand eingeschaltet.</translation>
    </message>
    <message>
      <source>Switched off by the user.</source>
      <translation>Von Hand ausgeschaltet.</translation>
    </message>
    <message>
      <source>'{front}' covers '{back}' where they touch (frames {first} to {last}).</source>
      <translation>„{front}“ verdeckt „{back}“, wo sie sich berühren (Bilder {first} bis {last}).</translation>
    </message>
    <message>
      <source>'{front}' covers '{back}' where they touch (frame {first}).</source>
      <translation>„{front}“ verdeckt „{back}“, wo sie sich berühren (Bild {first}).</translation>
    </message>
    <message>
      <source>There is 1 more such pair.</source>
      <translation>Es gibt noch ein solches Paar.</translation>
    </message>
    <message>
      <source>There are {count} more such pairs.</source>
      <translation>Es gibt noch {count} solche Paare.</translation>
    </message>
    <message>
      <source>No two objects ever touch.</source>
      <translation>Keine zwei Objekte berühren sich je.</translation>
    </message>
    <message>
      <source>{percent:.0f} % of all pixels show no object.</source>
      <translation>{percent:.0f} % aller Pixel zeigen kein Objekt.</translation>
    </message>
    <message>
      <source>The camera shifts the background by up to {pixels:.1f} px ({source}).</source>
      <translation>Die Kamera verschiebt den Hintergrund um bis zu {pixels:.1f} px ({source}).</translation>
    </message>
    <message>
      <source>The camera stands still ({source}).</source>
      <translation>Die Kamera steht still ({source}).</translation>
    </message>
    <message>
      <source>Every object moves like a rigid body as far as flow and outlines show.</source>
      <translation>Jedes Objekt bewegt sich wie ein starrer Körper, soweit Fluss und Umrisse es zeigen.</translation>
    </message>
    <message>
      <source>'{name}' bends {times:.1f} times as much as turning rigid objects seem to.</source>
      <translation>„{name}“ biegt sich {times:.1f}-mal so stark, wie es drehende starre Objekte zu tun scheinen.</translation>
    </message>
    <message>
      <source>Rigid all the same: {names}.</source>
      <translation>Starr trotzdem: {names}.</translation>
    </message>
    <message>
      <source>Brightness changes by {percent:.0f} % over the clip.</source>
      <translation>Die Helligkeit ändert sich im Clip um {percent:.0f} %.</translation>
    </message>
    <message>
      <source>The light stays the same.</source>
      <translation>Das Licht bleibt gleich.</translation>
    </message>
    <message>
      <source>An object turns by {degrees:.0f} degrees, the light does not.</source>
      <translation>Ein Objekt dreht sich um {degrees:.0f} Grad, das Licht nicht.</translation>
    </message>
    <message>
      <source>No object turns much.</source>
      <translation>Kein Objekt dreht sich nennenswert.</translation>
    </message>
    <message>
      <source>Looked at from up to {degrees:.0f} degrees aside, {percent:.0f} % of an object was never seen.</source>
      <translation>Aus bis zu {degrees:.0f} Grad von der Seite betrachtet, wurden {percent:.0f} % eines Objekts nie gesehen.</translation>
    </message>
    <message>
      <source>The prior {prior} draws it.</source>
      <translation>Der Prior {prior} zeichnet es.</translation>
    </message>
    <message>
      <source>No prior is installed to draw it.</source>
      <translation>Kein Prior ist installiert, der es zeichnet.</translation>
    </message>
    <message>
      <source>{count} objects must be kept apart.</source>
      <translation>{count} Objekte müssen auseinandergehalten werden.</translation>
    </message>
    <message>
      <source>There is one object only.</source>
      <translation>Es gibt nur ein Objekt.</translation>
    </message>
    <message>
      <source>{percent:.0f} % of the objects' pixels have a depth ({source}).</source>
      <translation>{percent:.0f} % der Objektpixel haben eine Tiefe ({source}).</translation>
    </message>
    <message>
      <source>Flow holds in {percent:.0f} % of the objects' pixels ({source}).</source>
      <translation>Der Fluss gilt in {percent:.0f} % der Objektpixel ({source}).</translation>
    </message>
    <message>
      <source>A single frame has no motion.</source>
      <translation>Ein einzelnes Bild hat keine Bewegung.</translation>
    </message>
    <message>
      <source>Usually {count:.0f} corners of an object can be followed.</source>
      <translation>Meist lassen sich {count:.0f} Ecken eines Objekts verfolgen.</translation>
    </message>
    <message>
      <source>No object is hidden and comes back.</source>
      <translation>Kein Objekt wird verdeckt und kommt wieder.</translation>
    </message>
    <message>
      <source>An object is hidden for 1 frame and comes back.</source>
      <translation>Ein Objekt ist ein Bild lang verdeckt und kommt wieder.</translation>
    </message>
    <message>
      <source>An object is hidden for up to {count} frames and comes back.</source>
      <translation>Ein Objekt ist bis zu {count} Bilder lang verdeckt und kommt wieder.</translation>
    </message>
    <message>
      <source>'{name}' leaves its rigid motion by {percent:.0f} % of its size: non-rigid motion was called in.</source>
      <translation>„{name}“ verlässt seine starre Bewegung um {percent:.0f} % seiner Größe: nicht-starre Bewegung wurde hinzugenommen.</translation>
    </message>
    <message>
      <source>Frames differ from the scene by up to {percent:.0f} % brightness: changing light was called in.</source>
      <translation>Bilder weichen um bis zu {percent:.0f} % Helligkeit von der Szene ab: wechselndes Licht wurde hinzugenommen.</translation>
    </message>
    <message>
      <source>Changing light was called in before the run was interrupted.</source>
      <translation>Wechselndes Licht wurde hinzugenommen, bevor der Lauf unterbrochen wurde.</translation>
    </message>
    <message>
      <source>Where surfaces face explains {percent:.0f} % of how their brightness changes: no shading.</source>
      <translation>Wohin Flächen zeigen, erklärt {percent:.0f} % ihrer Helligkeitsänderung: keine Schattierung.</translation>
    </message>
    <message>
      <source>Left out before the run was interrupted.</source>
      <translation>Weggelassen, bevor der Lauf unterbrochen wurde.</translation>
    </message>
    <message>
      <source>What the prior says was no usable number {times} times in a row: it is switched off.</source>
      <translation>Was der Prior sagt, war {times}-mal hintereinander keine brauchbare Zahl: er ist abgeschaltet.</translation>
    </message>
    <message>
      <source>Held-out pixels have {psnr:.2f} dB with the Gaussians the prior invented and {without:.2f} dB without: it is switched off.</source>
      <translation>Zurückgehaltene Pixel haben {psnr:.2f} dB mit den Gaußglocken, die der Prior erfand, und {without:.2f} dB ohne sie: er ist abgeschaltet.</translation>
    </message>
    <message>
      <source>one frame of contact is enough to hide</source>
      <translation>ein Bild mit Berührung genügt zum Verdecken</translation>
    </message>
    <message>
      <source>less than a twentieth is left to the objects' edges</source>
      <translation>weniger als ein Zwanzigstel bleibt den Rändern der Objekte überlassen</translation>
    </message>
    <message>
      <source>half a pixel cannot be seen</source>
      <translation>ein halbes Pixel sieht man nicht</translation>
    </message>
    <message>
      <source>rigid objects stay under {mode:.1f} % (fourth mode of flow) and {outline:.0f} % (outline) of their size, {stretch:.0f} % of height and {lean:.2g} of lean</source>
      <translation>starre Objekte bleiben unter {mode:.1f} % (vierte Mode des Flusses) und {outline:.0f} % (Umriss) ihrer Größe, {stretch:.0f} % der Höhe und {lean:.2g} Neigung</translation>
    </message>
    <message>
      <source>steady light measures under 5 % on the shared clips</source>
      <translation>stetiges Licht misst auf den Beispielclips unter 5 %</translation>
    </message>
    <message>
      <source>turned by 20 degrees, a surface gains or loses a third of the light</source>
      <translation>um 20 Grad gedreht, gewinnt oder verliert eine Fläche ein Drittel des Lichts</translation>
    </message>
    <message>
      <source>the rim's own Gaussians close less than a tenth</source>
      <translation>weniger als ein Zehntel schließen die Gaussians am Rand selbst</translation>
    </message>
    <message>
      <source>one object cannot be taken for another</source>
      <translation>ein Objekt lässt sich nicht mit einem anderen verwechseln</translation>
    </message>
    <message>
      <source>half of the objects' pixels</source>
      <translation>die Hälfte der Objektpixel</translation>
    </message>
    <message>
      <source>below a fifth wrong vectors outweigh right ones</source>
      <translation>unter einem Fünftel überwiegen falsche Vektoren</translation>
    </message>
    <message>
      <source>four points fix a similarity with one to spare</source>
      <translation>vier Punkte legen eine Ähnlichkeit fest, einer mehr als nötig</translation>
    </message>
    <message>
      <source>one frame without it must be bridged</source>
      <translation>ein Bild ohne das Objekt muss überbrückt werden</translation>
    </message>
    <message>
      <source>% of frames</source>
      <translation>% der Bilder</translation>
    </message>
    <message>
      <source>% of pixels</source>
      <translation>% der Pixel</translation>
    </message>
    <message>
      <source>x rigid</source>
      <translation>x starr</translation>
    </message>
    <message>
      <source>% brightness</source>
      <translation>% Helligkeit</translation>
    </message>
    <message>
      <source>degrees</source>
      <translation>Grad</translation>
    </message>
    <message>
      <source>% of a view</source>
      <translation>% einer Ansicht</translation>
    </message>
    <message>
      <source>% of object pixels</source>
      <translation>% der Objektpixel</translation>
    </message>
    <message>
      <source>corners per object</source>
      <translation>Ecken je Objekt</translation>
    </message>
    <message>
      <source>the camera is taken to stand still; its field of view is taken to be {degrees:.3g} degrees high</source>
      <translation>angenommen wird, dass die Kamera stillsteht und ihr Sichtfeld {degrees:.3g} Grad hoch ist</translation>
    </message>
    <message>
      <source>the camera's motion is a guess: it is taken to turn on the spot; its field of view is taken to be {degrees:.3g} degrees high</source>
      <translation>die Bewegung der Kamera ist geschätzt: angenommen wird, dass sie sich auf der Stelle dreht und ihr Sichtfeld {degrees:.3g} Grad hoch ist</translation>
    </message>
    <message>
      <source>the camera's motion is a guess from background points; its field of view is taken to be {degrees:.3g} degrees high</source>
      <translation>die Bewegung der Kamera ist aus Punkten des Hintergrunds geschätzt; angenommen wird ein Sichtfeld von {degrees:.3g} Grad Höhe</translation>
    </message>
    <message>
      <source>depth comes from {source}</source>
      <translation>die Tiefe kommt von {source}</translation>
    </message>
    <message>
      <source>depth comes from {source}; its scale and shift are a guess, so distances are an order, not a measure</source>
      <translation>die Tiefe kommt von {source}; ihr Maßstab und Nullpunkt sind geschätzt, Abstände sind also eine Reihenfolge, kein Maß</translation>
    </message>
    <message>
      <source>depth is a guess from {method}; distances between objects are an order, not a measure</source>
      <translation>die Tiefe ist geschätzt aus {method}; Abstände zwischen Objekten sind eine Reihenfolge, kein Maß</translation>
    </message>
    <message>
      <source>ground contact, occlusion order and rounded shapes</source>
      <translation>Bodenkontakt, Verdeckungen und gerundeten Formen</translation>
    </message>
    <message>
      <source>the depth's scale jumped by up to {percent:.1f} % from frame to frame and was brought to rest</source>
      <translation>der Maßstab der Tiefe sprang um bis zu {percent:.1f} % von Bild zu Bild und wurde beruhigt</translation>
    </message>
    <message>
      <source>{share:.1%} of the background is never seen and was painted in from around it</source>
      <translation>{share:.1%} des Hintergrunds sind nie zu sehen und wurden aus der Umgebung ergänzt</translation>
    </message>
    <message>
      <source>the clip has masks, so the boxes were not used</source>
      <translation>der Clip hat Masken, die Rahmen wurden daher nicht verwendet</translation>
    </message>
    <message>
      <source>masks are a guess from {source}; look at them before trusting the scene</source>
      <translation>die Masken sind geschätzt mit {source}; vor der Arbeit mit der Szene ansehen</translation>
    </message>
    <message>
      <source>{count} of {frames} frames have no mask; theirs are a guess carried on by optical flow</source>
      <translation>{count} von {frames} Bildern haben keine Maske; ihre ist geschätzt, vom optischen Fluss weitergetragen</translation>
    </message>
    <message>
      <source>{count} of {frames} frames of {name} cannot be decoded and are left out</source>
      <translation>{count} von {frames} Bildern von {name} sind nicht lesbar und fehlen</translation>
    </message>
    <message>
      <source>reading the clip</source>
      <translation>liest den Clip</translation>
    </message>
    <message>
      <source>looking at the clip: {stage}, {percent:.0f} %</source>
      <translation>untersucht den Clip: {stage}, {percent:.0f} %</translation>
    </message>
    <message>
      <source>loading the optimiser</source>
      <translation>lädt die Optimierung</translation>
    </message>
    <message>
      <source>compiling the CPU kernels, once on this machine (about 10 seconds)</source>
      <translation>übersetzt die Rechenkerne, einmal auf diesem Rechner (etwa 10 Sekunden)</translation>
    </message>
    <message>
      <source>lifting one frame</source>
      <translation>hebt ein Bild in den Raum</translation>
    </message>
    <message>
      <source>optimising</source>
      <translation>optimiert</translation>
    </message>
    <message>
      <source>writing the scene</source>
      <translation>schreibt die Szene</translation>
    </message>
    <message>
      <source>masks</source>
      <translation>Masken</translation>
    </message>
    <message>
      <source>cameras</source>
      <translation>Kameras</translation>
    </message>
    <message>
      <source>depth</source>
      <translation>Tiefe</translation>
    </message>
    <message>
      <source>background</source>
      <translation>Hintergrund</translation>
    </message>
    <message>
      <source>first scene</source>
      <translation>erste Szene</translation>
    </message>
    <message>
      <source>lift</source>
      <translation>Anheben</translation>
    </message>
    <message>
      <source>joint</source>
      <translation>gemeinsam</translation>
    </message>
    <message>
      <source>there was no time to follow every object exactly; give more budget</source>
      <translation>die Zeit reichte nicht, jedem Objekt genau zu folgen; ein größeres Budget hilft</translation>
    </message>
    <message>
      <source>the motion of {name} could not be followed; it goes where its pixels are</source>
      <translation>der Bewegung von {name} war nicht zu folgen; es steht, wo seine Pixel sind</translation>
    </message>
    <message>
      <source>object {name} is never visible and is left out</source>
      <translation>das Objekt {name} ist nie zu sehen und wird weggelassen</translation>
    </message>
    <message>
      <source>the prior {name} is expected to need {megabytes:.0f} MiB</source>
      <translation>der Prior {name} braucht voraussichtlich {megabytes:.0f} MiB</translation>
    </message>
    <message>
      <source>the prior is off for {name}: {reason}</source>
      <translation>der Prior ist für {name} abgeschaltet: {reason}</translation>
    </message>
    <message>
      <source>the prior is off for {name} in frames {frames}</source>
      <translation>der Prior ist für {name} abgeschaltet in den Bildern {frames}</translation>
    </message>
    <message>
      <source>{percent:.2g} % of what the prior said of {name} was no usable number and is left out</source>
      <translation>{percent:.2g} % dessen, was der Prior über {name} sagte, waren keine brauchbaren Zahlen und werden weggelassen</translation>
    </message>
    <message>
      <source>{count} Gaussians of {name} were not finite and were made transparent</source>
      <translation>{count} Gaußglocken von {name} waren nicht endlich und wurden durchsichtig gemacht</translation>
    </message>
    <message>
      <source>a step was left out: {culprits} not finite</source>
      <translation>ein Schritt wurde ausgelassen: {culprits} nicht endlich</translation>
    </message>
    <message>
      <source>{count} bad steps in a row: back to the last good state, learning rates x {rate:g}</source>
      <translation>{count} schlechte Schritte nacheinander: zurück zum letzten guten Stand, Lernraten x {rate:g}</translation>
    </message>
    <message>
      <source>{count} gradients of {what} of {name} were not finite and were left out</source>
      <translation>{count} Gradienten von {what} von {name} waren nicht endlich und wurden ausgelassen</translation>
    </message>
    <message>
      <source>{count} {what} of {name} were limited to +-{limit:g}</source>
      <translation>{count} {what} von {name} wurden auf +-{limit:g} begrenzt</translation>
    </message>
    <message>
      <source>{count} quaternions of {name} were made unit ones</source>
      <translation>{count} Quaternionen von {name} wurden auf Länge eins gebracht</translation>
    </message>
    <message>
      <source>point {number} of {name}</source>
      <translation>Punkt {number} von {name}</translation>
    </message>
    <message>
      <source>object {number}</source>
      <translation>Objekt {number}</translation>
    </message>
    <message>
      <source>frame {first}</source>
      <translation>Bild {first}</translation>
    </message>
    <message>
      <source>frames {first} to {last}</source>
      <translation>Bilder {first} bis {last}</translation>
    </message>
    <message>
      <source>Place {point}</source>
      <translation>Setzen: {point}</translation>
    </message>
    <message>
      <source>Delete the key of {point}</source>
      <translation>Schlüssel löschen: {point}</translation>
    </message>
    <message>
      <source>{point} visible, {frames}</source>
      <translation>{point} sichtbar, {frames}</translation>
    </message>
    <message>
      <source>{point} occluded, {frames}</source>
      <translation>{point} verdeckt, {frames}</translation>
    </message>
    <message>
      <source>{point} out of view, {frames}</source>
      <translation>{point} außerhalb des Bildes, {frames}</translation>
    </message>
    <message>
      <source>{point} not annotated, {frames}</source>
      <translation>{point} nicht annotiert, {frames}</translation>
    </message>
    <message>
      <source>{point} uncertain, {frames}</source>
      <translation>{point} unsicher, {frames}</translation>
    </message>
    <message>
      <source>{point} certain, {frames}</source>
      <translation>{point} sicher, {frames}</translation>
    </message>
    <message>
      <source>Accept {point}</source>
      <translation>Annehmen: {point}</translation>
    </message>
    <message>
      <source>Accept {count} points</source>
      <translation>{count} Punkte annehmen</translation>
    </message>
    <message>
      <source>Reopen {count} points</source>
      <translation>{count} Punkte wieder öffnen</translation>
    </message>
    <message>
      <source>Fill mode of {point}</source>
      <translation>Füllart ändern: {point}</translation>
    </message>
    <message>
      <source>Solve {point}</source>
      <translation>Lösen: {point}</translation>
    </message>
    <message>
      <source>Solve {count} tracks</source>
      <translation>{count} Spuren lösen</translation>
    </message>
    <message>
      <source>Seed {count} tracks</source>
      <translation>{count} Spuren vorschlagen</translation>
    </message>
    <message>
      <source>Seed {count} tracks by {name}</source>
      <translation>{count} Spuren vorschlagen durch {name}</translation>
    </message>
    <message>
      <source>Merge {count} tracks</source>
      <translation>{count} Spuren zusammenführen</translation>
    </message>
    <message>
      <source>Import {count} tracks</source>
      <translation>{count} Spuren importieren</translation>
    </message>
    <message>
      <source>Set objects</source>
      <translation>Objekte setzen</translation>
    </message>
    <message>
      <source>Candidates from the masks</source>
      <translation>Kandidaten aus den Masken</translation>
    </message>
    <message>
      <source>Cut out {name}</source>
      <translation>{name} ausschneiden</translation>
    </message>
    <message>
      <source>Choose {name}</source>
      <translation>{name} wählen</translation>
    </message>
    <message>
      <source>Reject {name}</source>
      <translation>{name} verwerfen</translation>
    </message>
    <message>
      <source>Name {name}</source>
      <translation>{name} benennen</translation>
    </message>
    <message>
      <source>Order of objects</source>
      <translation>Reihenfolge der Objekte</translation>
    </message>
    <message>
      <source>At most {count} objects</source>
      <translation>Höchstens {count} Objekte</translation>
    </message>
    <message>
      <source>At most {count} points each</source>
      <translation>Höchstens {count} Punkte je Objekt</translation>
    </message>
    <message>
      <source>Add point {number}</source>
      <translation>Punkt {number} anlegen</translation>
    </message>
    <message>
      <source>Delete point {number}</source>
      <translation>Punkt {number} löschen</translation>
    </message>
    <message>
      <source>Change point {number}</source>
      <translation>Punkt {number} ändern</translation>
    </message>
    <message>
      <source>Name points</source>
      <translation>Punkte benennen</translation>
    </message>
    <message>
      <source>Swap point {one} and point {other}</source>
      <translation>Punkt {one} und Punkt {other} tauschen</translation>
    </message>
    <message>
      <source>Split point {number} at frame {frame}</source>
      <translation>Punkt {number} bei Bild {frame} teilen</translation>
    </message>
    <message>
      <source>Join point {one} and point {other}</source>
      <translation>Punkt {one} und Punkt {other} verbinden</translation>
    </message>
    <message>
      <source>Unlock</source>
      <translation>Entsperren</translation>
    </message>
    <message>
      <source>Note</source>
      <translation>Notiz</translation>
    </message>
    <message>
      <source>Set {what}</source>
      <translation>Angabe ändern: {what}</translation>
    </message>
    <message>
      <source>consent</source>
      <translation>Einwilligung</translation>
    </message>
    <message>
      <source>Needs fix: {reason}</source>
      <translation>Nacharbeit nötig: {reason}</translation>
    </message>
    <message>
      <source>drift</source>
      <translation>driftet ab</translation>
    </message>
    <message>
      <source>jump</source>
      <translation>springt</translation>
    </message>
    <message>
      <source>swap</source>
      <translation>vertauscht</translation>
    </message>
    <message>
      <source>occlusion wrong</source>
      <translation>Verdeckung falsch</translation>
    </message>
    <message>
      <source>wrong part</source>
      <translation>falsche Stelle</translation>
    </message>
    <message>
      <source>imprecise</source>
      <translation>ungenau</translation>
    </message>
    <message>
      <source>sudden motion</source>
      <translation>plötzliche Bewegung</translation>
    </message>
    <message>
      <source>neighbouring frames contradict it</source>
      <translation>Nachbarbilder widersprechen</translation>
    </message>
    <message>
      <source>looks different from its keys</source>
      <translation>sieht anders aus als an seinen Schlüsseln</translation>
    </message>
    <message>
      <source>trackers disagree</source>
      <translation>Verfolger sind uneins</translation>
    </message>
    <message>
      <source>contradicts the object's mask</source>
      <translation>widerspricht der Maske des Objekts</translation>
    </message>
    <message>
      <source>moves unlike the other points of the object</source>
      <translation>bewegt sich anders als die übrigen Punkte des Objekts</translation>
    </message>
    <message>
      <source>state changes back and forth</source>
      <translation>Zustand wechselt hin und her</translation>
    </message>
    <message>
      <source>the tracker is unsure</source>
      <translation>der Verfolger ist unsicher</translation>
    </message>
    <message>
      <source>far from any key</source>
      <translation>weit von jedem Schlüssel</translation>
    </message>
  </context>
</TS>
