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
      <source>This frame is not on show yet.</source>
      <translation>Dieses Bild ist noch nicht zu sehen.</translation>
    </message>
    <message>
      <source>Solving; the frame is accepted right after.</source>
      <translation>Wird gelöst; das Bild wird gleich danach angenommen.</translation>
    </message>
    <message>
      <source>Export the log</source>
      <translation>Protokoll exportieren</translation>
    </message>
    <message>
      <source>when (local time)</source>
      <translation>wann (Ortszeit)</translation>
    </message>
    <message>
      <source>who</source>
      <translation>wer</translation>
    </message>
    <message>
      <source>what</source>
      <translation>was</translation>
    </message>
    <message>
      <source>in effect</source>
      <translation>gilt</translation>
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
      <source>before</source>
      <translation>vorher</translation>
    </message>
    <message>
      <source>after</source>
      <translation>nachher</translation>
    </message>
    <message>
      <source>version</source>
      <translation>Version</translation>
    </message>
    <message>
      <source>Lines of which point</source>
      <translation>Zeilen welches Punkts</translation>
    </message>
    <message>
      <source>Lines of which person</source>
      <translation>Zeilen welcher Person</translation>
    </message>
    <message>
      <source>Only what stands</source>
      <translation>Nur was gilt</translation>
    </message>
    <message>
      <source>Leaves out edits that were undone, undoing itself and named moments.</source>
      <translation>Lässt zurückgenommene Änderungen, das Zurücknehmen selbst und benannte Momente weg.</translation>
    </message>
    <message>
      <source>Audit log</source>
      <translation>Protokoll der Änderungen</translation>
    </message>
    <message>
      <source>Every line carries a hash of itself and the line before: nothing can be changed, added or taken out afterwards without being seen.</source>
      <translation>Jede Zeile trägt einen Hash von sich und der Zeile davor: Nichts kann nachträglich geändert, ergänzt oder entfernt werden, ohne dass man es sieht.</translation>
    </message>
    <message>
      <source>Checking …</source>
      <translation>Wird geprüft …</translation>
    </message>
    <message>
      <source>all points</source>
      <translation>alle Punkte</translation>
    </message>
    <message>
      <source>everybody</source>
      <translation>alle Personen</translation>
    </message>
    <message>
      <source>The chain is whole: none of {n} lines was changed, added or taken out afterwards.</source>
      <translation>Die Kette ist vollständig: Keine von {n} Zeilen wurde nachträglich geändert, ergänzt oder entfernt.</translation>
    </message>
    <message>
      <source>yes</source>
      <translation>ja</translation>
    </message>
    <message>
      <source>undone</source>
      <translation>zurückgenommen</translation>
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
      <source>Reading the log …</source>
      <translation>Das Protokoll wird gelesen …</translation>
    </message>
    <message>
      <source>Check the chain</source>
      <translation>Kette prüfen</translation>
    </message>
    <message>
      <source>Export the log…</source>
      <translation>Protokoll exportieren…</translation>
    </message>
    <message>
      <source>{n} lines are missing, the first is number {first}: this history is not whole.</source>
      <translation>{n} Zeilen fehlen, die erste ist Nummer {first}: Diese Geschichte ist nicht vollständig.</translation>
    </message>
    <message>
      <source>{n} of {all} lines were changed after they were made. The first: number {first}, “{title}”, {when}.</source>
      <translation>{n} von {all} Zeilen wurden nachträglich geändert. Die erste: Nummer {first}, „{title}“, {when}.</translation>
    </message>
    <message>
      <source>All {n} lines are whole, but the state kept after number {first} is not what they lead to: it was changed afterwards.</source>
      <translation>Alle {n} Zeilen sind unversehrt, aber der nach Nummer {first} abgelegte Stand ist nicht der, zu dem sie führen: er wurde nachträglich geändert.</translation>
    </message>
    <message>
      <source>{n} of {all} lines are on the disk and whole; the rest is not written yet.</source>
      <translation>{n} von {all} Zeilen sind gespeichert und unversehrt; der Rest ist noch nicht geschrieben.</translation>
    </message>
    <message>
      <source>{points} and {n} more</source>
      <translation>{points} und {n} weitere</translation>
    </message>
    <message>
      <source>object {n}</source>
      <translation>Objekt {n}</translation>
    </message>
    <message>
      <source>Named: {name}</source>
      <translation>Benannt: {name}</translation>
    </message>
    <message>
      <source>nobody named</source>
      <translation>niemandem mit Namen</translation>
    </message>
    <message>
      <source>{n} of {all} lines</source>
      <translation>{n} von {all} Zeilen</translation>
    </message>
    <message>
      <source>{first} to {last} ({n})</source>
      <translation>{first} bis {last} ({n})</translation>
    </message>
    <message>
      <source>Saved: {name}</source>
      <translation>Gespeichert: {name}</translation>
    </message>
    <message>
      <source>The point is back where it was.</source>
      <translation>Der Punkt ist wieder, wo er war.</translation>
    </message>
    <message>
      <source>Marked: frames {a} to {b}. A state or X applies to them.</source>
      <translation>Markiert: Bilder {a} bis {b}. Ein Zustand oder X gilt für sie.</translation>
    </message>
    <message>
      <source>There is no object {n} in the order.</source>
      <translation>Es gibt kein Objekt {n} in der Reihenfolge.</translation>
    </message>
    <message>
      <source>Pg↑</source>
      <translation>Bild↑</translation>
    </message>
    <message>
      <source>Pg↓</source>
      <translation>Bild↓</translation>
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
      <source>Take over writing</source>
      <translation>Schreiben übernehmen</translation>
    </message>
    <message>
      <source>stride</source>
      <translation>Schrittweite</translation>
    </message>
    <message>
      <source>NOT SAVED</source>
      <translation>NICHT GESPEICHERT</translation>
    </message>
    <message>
      <source>saved</source>
      <translation>gespeichert</translation>
    </message>
    <message>
      <source>What they do is shown here within a second; nothing can be changed here.</source>
      <translation>Was dort geschieht, steht binnen einer Sekunde hier; hier kann nichts geändert werden.</translation>
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
      <source>Name this moment</source>
      <translation>Diesen Stand benennen</translation>
    </message>
    <message>
      <source>Name</source>
      <translation>Name</translation>
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
      <source>Dope sheet: states of all points over time</source>
      <translation>Zeitübersicht: Zustände aller Punkte</translation>
    </message>
    <message>
      <source>No points yet: place them in step 2.</source>
      <translation>Noch keine Punkte: setzen Sie sie in Schritt 2.</translation>
    </message>
    <message>
      <source>Choose a point that has a track first.</source>
      <translation>Erst einen Punkt wählen, der eine Spur hat.</translation>
    </message>
    <message>
      <source>This track is locked; unlock it first (Ctrl+L).</source>
      <translation>Diese Spur ist gesperrt; erst entsperren (Ctrl+L).</translation>
    </message>
    <message>
      <source>This track has nothing from this frame on; go to an earlier frame.</source>
      <translation>Diese Spur hat ab diesem Bild nichts; geh zu einem früheren Bild.</translation>
    </message>
    <message>
      <source>There is no other track that is not locked.</source>
      <translation>Es gibt keine andere Spur, die nicht gesperrt ist.</translation>
    </message>
    <message>
      <source>{n} frames are taken over. In {both} frames both have a place, in {keyed} of them both were placed by hand; otherwise what a person placed or accepted goes first.</source>
      <translation>{n} Bilder werden übernommen. In {both} Bildern haben beide einen Ort, in {keyed} davon wurden beide von Hand gesetzt; sonst geht vor, was ein Mensch gesetzt oder angenommen hat.</translation>
    </message>
    <message>
      <source>Swap two points</source>
      <translation>Zwei Punkte tauschen</translation>
    </message>
    <message>
      <source>Split a track</source>
      <translation>Eine Spur teilen</translation>
    </message>
    <message>
      <source>Join two tracks</source>
      <translation>Zwei Spuren verbinden</translation>
    </message>
    <message>
      <source>{point} changes places with:</source>
      <translation>{point} tauscht den Platz mit:</translation>
    </message>
    <message>
      <source>{point} takes the frames of:</source>
      <translation>{point} übernimmt die Bilder von:</translation>
    </message>
    <message>
      <source>{point} is, from frame {n} on:</source>
      <translation>{point} ist ab Bild {n}:</translation>
    </message>
    <message>
      <source>Points</source>
      <translation>Punkte</translation>
    </message>
    <message>
      <source>Frames</source>
      <translation>Bilder</translation>
    </message>
    <message>
      <source>Whose places stand where both have some</source>
      <translation>Wessen Orte gelten, wo beide welche haben</translation>
    </message>
    <message>
      <source>The frame shows what comes of it; , and . step through it. One step; it can be undone.</source>
      <translation>Das Bild zeigt, was daraus wird; , und . gehen Bild für Bild. Ein Schritt; er lässt sich zurücknehmen.</translation>
    </message>
    <message>
      <source>Swap</source>
      <translation>Tauschen</translation>
    </message>
    <message>
      <source>Split</source>
      <translation>Teilen</translation>
    </message>
    <message>
      <source>Join</source>
      <translation>Verbinden</translation>
    </message>
    <message>
      <source>Neither point has a place in these frames; nothing would change.</source>
      <translation>Keiner der Punkte hat in diesen Bildern einen Ort; nichts würde sich ändern.</translation>
    </message>
    <message>
      <source>where both were placed: {point}</source>
      <translation>wo beide gesetzt wurden: {point}</translation>
    </message>
    <message>
      <source>Swapped; Ctrl+Z takes it back.</source>
      <translation>Getauscht; Strg+Z nimmt es zurück.</translation>
    </message>
    <message>
      <source>Split; the new part is active now.</source>
      <translation>Geteilt; der neue Teil ist jetzt aktiv.</translation>
    </message>
    <message>
      <source>Joined; Ctrl+Z takes it back.</source>
      <translation>Verbunden; Strg+Z nimmt es zurück.</translation>
    </message>
    <message>
      <source>in all frames</source>
      <translation>in allen Bildern</translation>
    </message>
    <message>
      <source>{n} frames move.</source>
      <translation>{n} Bilder ziehen um.</translation>
    </message>
    <message>
      <source>{n} frames change places.</source>
      <translation>{n} Bilder tauschen den Platz.</translation>
    </message>
    <message>
      <source>{n} frames are taken over; no frame has both.</source>
      <translation>{n} Bilder werden übernommen; in keinem haben beide einen Ort.</translation>
    </message>
    <message>
      <source>from this frame on ({a} to {b})</source>
      <translation>ab diesem Bild ({a} bis {b})</translation>
    </message>
    <message>
      <source>up to this frame ({a} to {b})</source>
      <translation>bis zu diesem Bild ({a} bis {b})</translation>
    </message>
    <message>
      <source>in this frame only ({a})</source>
      <translation>nur in diesem Bild ({a})</translation>
    </message>
    <message>
      <source>in the marked frames {a} to {b}</source>
      <translation>in den markierten Bildern {a} bis {b}</translation>
    </message>
    <message>
      <source>locked</source>
      <translation>gesperrt</translation>
    </message>
    <message>
      <source>read only: {name} is editing ({pid}/{host})</source>
      <translation>nur lesbar: {name} bearbeitet ({pid}/{host})</translation>
    </message>
    <message>
      <source>another program</source>
      <translation>ein anderes Programm</translation>
    </message>
    <message>
      <source>read only</source>
      <translation>nur lesen</translation>
    </message>
    <message>
      <source>You are writing this project now.</source>
      <translation>Ab jetzt schreibst du dieses Projekt.</translation>
    </message>
    <message>
      <source>Another program was faster: the project stays read only here.</source>
      <translation>Ein anderes Programm war schneller: hier bleibt das Projekt nur lesbar.</translation>
    </message>
    <message>
      <source>read only: not up to date</source>
      <translation>nur lesbar: nicht aktuell</translation>
    </message>
    <message>
      <source>somebody</source>
      <translation>jemand</translation>
    </message>
    <message>
      <source>read only: {name} has left</source>
      <translation>nur lesbar: {name} ist fort</translation>
    </message>
    <message>
      <source>No more keys that way.</source>
      <translation>In dieser Richtung gibt es keine Schlüssel mehr.</translation>
    </message>
    <message>
      <source>The clip is still being read.</source>
      <translation>Der Clip wird noch gelesen.</translation>
    </message>
    <message>
      <source>All were looked at; again from the worst: </source>
      <translation>Alle sind angesehen; von vorn mit der schlimmsten: </translation>
    </message>
    <message>
      <source>Nothing suspicious is left, as far as motion tells: there are no masks.</source>
      <translation>Nichts Verdächtiges mehr, soweit es die Bewegung verrät: Es gibt keine Masken.</translation>
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
      <source>frame</source>
      <translation>Bild</translation>
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
      <source>Nothing is lost by going elsewhere: what is undone stays here, and the way back is listed too.</source>
      <translation>Beim Wechseln geht nichts verloren: Zurückgenommenes bleibt hier stehen, und der Weg zurück auch.</translation>
    </message>
    <message>
      <source>History</source>
      <translation>Verlauf</translation>
    </message>
    <message>
      <source>Named moments only</source>
      <translation>Nur benannte Momente</translation>
    </message>
    <message>
      <source>States of the history</source>
      <translation>Stände des Verlaufs</translation>
    </message>
    <message>
      <source>Go to this state</source>
      <translation>Zu diesem Stand gehen</translation>
    </message>
    <message>
      <source>Back to before the jump</source>
      <translation>Zurück vor den Sprung</translation>
    </message>
    <message>
      <source>Show earlier</source>
      <translation>Frühere zeigen</translation>
    </message>
    <message>
      <source>The beginning</source>
      <translation>Der Anfang</translation>
    </message>
    <message>
      <source>Here you are</source>
      <translation>Hier bist du</translation>
    </message>
    <message>
      <source>Search</source>
      <translation>Suchen</translation>
    </message>
    <message>
      <source>Deed</source>
      <translation>Was getan wurde</translation>
    </message>
    <message>
      <source>Who</source>
      <translation>Wer</translation>
    </message>
    <message>
      <source>When</source>
      <translation>Wann</translation>
    </message>
    <message>
      <source>Point</source>
      <translation>Punkt</translation>
    </message>
    <message>
      <source>Frame</source>
      <translation>Bild</translation>
    </message>
    <message>
      <source>Read only: another program has this project open.</source>
      <translation>Nur lesbar: ein anderes Programm hat dieses Projekt geöffnet.</translation>
    </message>
    <message>
      <source>Undone</source>
      <translation>Zurückgenommen</translation>
    </message>
    <message>
      <source>In effect</source>
      <translation>In Kraft</translation>
    </message>
    <message>
      <source>Another branch: {n} deeds</source>
      <translation>Ein anderer Zweig: {n} Schritte</translation>
    </message>
    <message>
      <source>A copy is made at every named moment. It is opened as a new project; this one stays as it is.</source>
      <translation>Bei jedem benannten Stand entsteht eine Kopie. Sie wird als neues Projekt geöffnet; dieses bleibt, wie es ist.</translation>
    </message>
    <message>
      <source>The clip was moved</source>
      <translation>Der Clip wurde verschoben</translation>
    </message>
    <message>
      <source>A folder…</source>
      <translation>Ein Ordner…</translation>
    </message>
    <message>
      <source>A video…</source>
      <translation>Ein Video…</translation>
    </message>
    <message>
      <source>Save a copy of the project</source>
      <translation>Kopie des Projekts speichern</translation>
    </message>
    <message>
      <source>Open a backup copy</source>
      <translation>Sicherungskopie öffnen</translation>
    </message>
    <message>
      <source>The clip's folder</source>
      <translation>Ordner des Clips</translation>
    </message>
    <message>
      <source>Not everything is saved</source>
      <translation>Nicht alles ist gespeichert</translation>
    </message>
    <message>
      <source>Try again</source>
      <translation>Erneut versuchen</translation>
    </message>
    <message>
      <source>Save a copy…</source>
      <translation>Kopie speichern…</translation>
    </message>
    <message>
      <source>Lose them</source>
      <translation>Verwerfen</translation>
    </message>
    <message>
      <source>There is no backup yet: naming a moment (Ctrl+S) makes one.</source>
      <translation>Es gibt noch keine Sicherung: einen Moment zu benennen (Strg+S) macht eine.</translation>
    </message>
    <message>
      <source>{name} is not at {path} any more. Where is it?</source>
      <translation>{name} liegt nicht mehr unter {path}. Wo ist es?</translation>
    </message>
    <message>
      <source>Edits that could not be written: {n}.</source>
      <translation>Änderungen, die nicht geschrieben werden konnten: {n}.</translation>
    </message>
    <message>
      <source>Free some space and try again, or save a copy elsewhere.</source>
      <translation>Platz schaffen und noch einmal versuchen, oder anderswo eine Kopie sichern.</translation>
    </message>
    <message>
      <source>The clip's video</source>
      <translation>Video des Clips</translation>
    </message>
    <message>
      <source>Seconds at work come from the log; a pause counts as one minute at most. A key belongs to whoever placed or moved it last. What is left and its time are for the stride set above the frame.</source>
      <translation>Die Arbeitszeit stammt aus dem Protokoll; eine Pause zählt höchstens eine Minute. Ein Schlüssel gehört, wer ihn zuletzt gesetzt oder verschoben hat. Was noch fehlt und wie lange es dauert, gilt für die Schrittweite über dem Bild.</translation>
    </message>
    <message>
      <source>Log and statistics</source>
      <translation>Protokoll und Statistik</translation>
    </message>
    <message>
      <source>Figures of the clip and its people</source>
      <translation>Zahlen zum Clip und zu den Personen</translation>
    </message>
    <message>
      <source>Time sheet</source>
      <translation>Zeitaufwand</translation>
    </message>
    <message>
      <source>Clip and people</source>
      <translation>Clip und Personen</translation>
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
      <source>Export the figures…</source>
      <translation>Zahlen exportieren…</translation>
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
      <source>clip</source>
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
      <source>tracks</source>
      <translation>Spuren</translation>
    </message>
    <message>
      <source>Export the figures</source>
      <translation>Zahlen exportieren</translation>
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
      <source>{n:.1f} h</source>
      <translation>{n:.1f} h</translation>
    </message>
    <message>
      <source>time at work</source>
      <translation>Arbeitszeit</translation>
    </message>
    <message>
      <source>keys per track (mean)</source>
      <translation>Schlüssel je Spur (Mittel)</translation>
    </message>
    <message>
      <source>time per track</source>
      <translation>Zeit je Spur</translation>
    </message>
    <message>
      <source>places looked at</source>
      <translation>angesehene Stellen</translation>
    </message>
    <message>
      <source>share looked at</source>
      <translation>Anteil angesehen</translation>
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
      <source>uncertain</source>
      <translation>unsicher</translation>
    </message>
    <message>
      <source>tracks sent back</source>
      <translation>zurückgegebene Spuren</translation>
    </message>
    <message>
      <source>share of reviewed tracks sent back</source>
      <translation>Anteil geprüfter Spuren, die zurückgingen</translation>
    </message>
    <message>
      <source>places still to look at</source>
      <translation>noch anzusehende Stellen</translation>
    </message>
    <message>
      <source>time for what is left</source>
      <translation>Zeit für den Rest</translation>
    </message>
    <message>
      <source>objects</source>
      <translation>Objekte</translation>
    </message>
    <message>
      <source>motion at 256 x 256</source>
      <translation>Bewegung bei 256 x 256</translation>
    </message>
    <message>
      <source>figure</source>
      <translation>Kennzahl</translation>
    </message>
    <message>
      <source>whole clip</source>
      <translation>ganzer Clip</translation>
    </message>
    <message>
      <source>{n} s</source>
      <translation>{n} s</translation>
    </message>
    <message>
      <source>{n:.1f} min</source>
      <translation>{n:.1f} min</translation>
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
      <source>Drawn: {n}. Cut out makes a mask of it; undo takes the last one back.</source>
      <translation>Gezeichnet: {n}. „Ausschneiden“ macht daraus eine Maske; „Rückgängig“ nimmt das Letzte zurück.</translation>
    </message>
    <message>
      <source>Cutting the object out of every frame …</source>
      <translation>Das Objekt wird aus jedem Bild geschnitten …</translation>
    </message>
    <message>
      <source>Draw inside the frame, not too small.</source>
      <translation>Im Bild zeichnen, nicht zu klein.</translation>
    </message>
    <message>
      <source>Something is being cut out already.</source>
      <translation>Es wird schon etwas ausgeschnitten.</translation>
    </message>
    <message>
      <source>The project is read only.</source>
      <translation>Das Projekt kann nur gelesen werden.</translation>
    </message>
    <message>
      <source>Draw something first.</source>
      <translation>Malen Sie zuerst etwas.</translation>
    </message>
    <message>
      <source>The pictures differ in {n} of {all} frames compared ({frames}): the projects may be of different clips.</source>
      <translation>Die Bilder unterscheiden sich in {n} von {all} verglichenen Bildern ({frames}): Die Projekte sind vielleicht von verschiedenen Clips.</translation>
    </message>
    <message>
      <source>The pictures of the two projects differ in every frame: they are of different clips.</source>
      <translation>Die Bilder der beiden Projekte unterscheiden sich durchweg: Sie sind von verschiedenen Clips.</translation>
    </message>
    <message>
      <source>The time stamps of the two projects differ: they may be of different clips.</source>
      <translation>Die Zeitstempel der beiden Projekte unterscheiden sich: Vielleicht gehören sie zu verschiedenen Clips.</translation>
    </message>
    <message>
      <source>The two projects are of clips of different names.</source>
      <translation>Die Clips der beiden Projekte heißen verschieden.</translation>
    </message>
    <message>
      <source>whole point</source>
      <translation>ganzer Punkt</translation>
    </message>
    <message>
      <source>name</source>
      <translation>Name</translation>
    </message>
    <message>
      <source>note</source>
      <translation>Notiz</translation>
    </message>
    <message>
      <source>review</source>
      <translation>Prüfung</translation>
    </message>
    <message>
      <source>object</source>
      <translation>Objekt</translation>
    </message>
    <message>
      <source>Compare with a second annotator</source>
      <translation>Mit einer zweiten Person vergleichen</translation>
    </message>
    <message>
      <source>What only they changed is taken over; of conflicts, what you choose (keys 1, 2, 3 for the row). The frame shows their point beside yours; , and . step through it. One step; it can be undone.</source>
      <translation>Was nur die anderen geändert haben, wird übernommen; bei Konflikten, was Sie wählen (Tasten 1, 2, 3 für die Zeile). Das Bild zeigt ihren Punkt neben Ihrem; , und . gehen durch die Bilder. Ein Schritt, der sich zurücknehmen lässt.</translation>
    </message>
    <message>
      <source>Merge</source>
      <translation>Zusammenführen</translation>
    </message>
    <message>
      <source>It is the same clip all the same</source>
      <translation>Es ist trotzdem derselbe Clip</translation>
    </message>
    <message>
      <source>No point in common.</source>
      <translation>Kein gemeinsamer Punkt.</translation>
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
      <source>{n} tracks in common. AJ {aj}, δ {delta}, OA {oa} %. Distance where both see the point: median {median} px, 90 % below {p90} px (1080 lines). Same state in {states}.</source>
      <translation>{n} gemeinsame Spuren. AJ {aj}, δ {delta}, OA {oa} %. Abstand, wo beide den Punkt sehen: Median {median} px, 90 % unter {p90} px (1080 Zeilen). Gleicher Zustand in {states}.</translation>
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
      <source>frame {n}</source>
      <translation>Bild {n}</translation>
    </message>
    <message>
      <source>{n} frames</source>
      <translation>{n} Bilder</translation>
    </message>
    <message>
      <source>theirs</source>
      <translation>ihres</translation>
    </message>
    <message>
      <source>frames {first} to {last}</source>
      <translation>Bilder {first} bis {last}</translation>
    </message>
    <message>
      <source>chosen</source>
      <translation>gewählt</translation>
    </message>
    <message>
      <source>rejected</source>
      <translation>verworfen</translation>
    </message>
    <message>
      <source>This track is locked and stays as it is; unlock it to merge it.</source>
      <translation>Diese Spur ist gesperrt und bleibt, wie sie ist; zum Zusammenführen entsperren.</translation>
    </message>
    <message>
      <source>mine</source>
      <translation>meines</translation>
    </message>
    <message>
      <source>the middle</source>
      <translation>die Mitte</translation>
    </message>
    <message>
      <source>Mouse in the frame</source>
      <translation>Maus im Bild</translation>
    </message>
    <message>
      <source>Keys that are held</source>
      <translation>Gehaltene Tasten</translation>
    </message>
    <message>
      <source>Mouse in the dope sheet</source>
      <translation>Maus im Dope Sheet</translation>
    </message>
    <message>
      <source>Mouse in the timeline</source>
      <translation>Maus in der Zeitleiste</translation>
    </message>
    <message>
      <source>Mouse in the graphs</source>
      <translation>Maus in den Kurven</translation>
    </message>
    <message>
      <source>Mouse in the strip</source>
      <translation>Maus im Streifen</translation>
    </message>
    <message>
      <source>Click</source>
      <translation>Klick</translation>
    </message>
    <message>
      <source>Places the active point here.</source>
      <translation>Setzt den aktiven Punkt hierher.</translation>
    </message>
    <message>
      <source>Click on a point</source>
      <translation>Klick auf einen Punkt</translation>
    </message>
    <message>
      <source>Makes that point the active one.</source>
      <translation>Macht diesen Punkt zum aktiven.</translation>
    </message>
    <message>
      <source>Drag</source>
      <translation>Ziehen</translation>
    </message>
    <message>
      <source>Moves the nearest point within 12 pixels of the screen.</source>
      <translation>Bewegt den nächsten Punkt im Umkreis von 12 Bildschirmpixeln.</translation>
    </message>
    <message>
      <source>Shift while dragging</source>
      <translation>Umschalt beim Ziehen</translation>
    </message>
    <message>
      <source>Moves it at an eighth of the speed.</source>
      <translation>Bewegt ihn mit einem Achtel der Geschwindigkeit.</translation>
    </message>
    <message>
      <source>Esc while dragging</source>
      <translation>Esc beim Ziehen</translation>
    </message>
    <message>
      <source>Puts it back where it was.</source>
      <translation>Legt ihn zurück, wo er war.</translation>
    </message>
    <message>
      <source>Click on an arrow at the rim</source>
      <translation>Klick auf einen Pfeil am Rand</translation>
    </message>
    <message>
      <source>Brings that point into the middle of the view.</source>
      <translation>Holt diesen Punkt in die Mitte der Ansicht.</translation>
    </message>
    <message>
      <source>Right click on a point</source>
      <translation>Rechtsklick auf einen Punkt</translation>
    </message>
    <message>
      <source>Occluded, or visible again.</source>
      <translation>Verdeckt, oder wieder sichtbar.</translation>
    </message>
    <message>
      <source>Drag with the tool Box</source>
      <translation>Ziehen mit dem Werkzeug Rahmen</translation>
    </message>
    <message>
      <source>A rectangle round the object.</source>
      <translation>Ein Rechteck um das Objekt.</translation>
    </message>
    <message>
      <source>Click or drag with On it, Not this</source>
      <translation>Klicken oder Ziehen mit „Darauf“, „Das nicht“</translation>
    </message>
    <message>
      <source>Marks what belongs to the object, or does not.</source>
      <translation>Markiert, was zum Objekt gehört oder nicht.</translation>
    </message>
    <message>
      <source>Wheel</source>
      <translation>Rad</translation>
    </message>
    <message>
      <source>Zooms at the mouse; the loupe while it is open.</source>
      <translation>Vergrößert an der Maus; die Lupe, solange sie offen ist.</translation>
    </message>
    <message>
      <source>Drag with the middle button, or where no point is</source>
      <translation>Ziehen mit der mittleren Taste, oder wo kein Punkt ist</translation>
    </message>
    <message>
      <source>Moves the picture.</source>
      <translation>Verschiebt das Bild.</translation>
    </message>
    <message>
      <source>Tab, Shift+Tab</source>
      <translation>Tab, Umschalt+Tab</translation>
    </message>
    <message>
      <source>Next point, point before.</source>
      <translation>Nächster Punkt, voriger Punkt.</translation>
    </message>
    <message>
      <source>Hold {view.loupe}</source>
      <translation>{view.loupe} halten</translation>
    </message>
    <message>
      <source>Opens the loupe beside the mouse.</source>
      <translation>Öffnet die Lupe neben der Maus.</translation>
    </message>
    <message>
      <source>Hold {view.hide}</source>
      <translation>{view.hide} halten</translation>
    </message>
    <message>
      <source>Hides all that is drawn over the frame.</source>
      <translation>Blendet alles aus, was über das Bild gezeichnet ist.</translation>
    </message>
    <message>
      <source>Hold {point.occluded} and step</source>
      <translation>{point.occluded} halten und weitergehen</translation>
    </message>
    <message>
      <source>Paints occluded over the frames gone through.</source>
      <translation>Malt „verdeckt“ über die durchlaufenen Bilder.</translation>
    </message>
    <message>
      <source>Hold {point.outside} and step</source>
      <translation>{point.outside} halten und weitergehen</translation>
    </message>
    <message>
      <source>Paints out of view.</source>
      <translation>Malt „außerhalb“.</translation>
    </message>
    <message>
      <source>Hold {point.visible} and step</source>
      <translation>{point.visible} halten und weitergehen</translation>
    </message>
    <message>
      <source>Paints visible.</source>
      <translation>Malt „sichtbar“.</translation>
    </message>
    <message>
      <source>Hold {point.nothing} and step</source>
      <translation>{point.nothing} halten und weitergehen</translation>
    </message>
    <message>
      <source>Forgets the places gone through.</source>
      <translation>Vergisst die durchlaufenen Stellen.</translation>
    </message>
    <message>
      <source>Goes to that frame and makes that point the active one.</source>
      <translation>Geht zu diesem Bild und macht diesen Punkt zum aktiven.</translation>
    </message>
    <message>
      <source>Drag over a row</source>
      <translation>Über eine Zeile ziehen</translation>
    </message>
    <message>
      <source>Paints the state that is chosen above it.</source>
      <translation>Malt den Zustand, der darüber gewählt ist.</translation>
    </message>
    <message>
      <source>Drag on the ruler</source>
      <translation>Auf dem Lineal ziehen</translation>
    </message>
    <message>
      <source>Goes through the frames.</source>
      <translation>Geht durch die Bilder.</translation>
    </message>
    <message>
      <source>Right click</source>
      <translation>Rechtsklick</translation>
    </message>
    <message>
      <source>Offers states, runs, keys, filling and returning it.</source>
      <translation>Bietet Zustände, Bereiche, Schlüssel, Füllung und Zurückgeben an.</translation>
    </message>
    <message>
      <source>Ctrl+wheel</source>
      <translation>Strg+Rad</translation>
    </message>
    <message>
      <source>Zooms in time about the mouse.</source>
      <translation>Zoomt in der Zeit um die Maus.</translation>
    </message>
    <message>
      <source>Wheel, Shift+wheel</source>
      <translation>Rad, Umschalt+Rad</translation>
    </message>
    <message>
      <source>Scrolls the rows, scrolls in time.</source>
      <translation>Rollt die Zeilen, rollt in der Zeit.</translation>
    </message>
    <message>
      <source>Middle button, Shift+drag</source>
      <translation>Mittlere Taste, Umschalt+Ziehen</translation>
    </message>
    <message>
      <source>Pulls rows and time along.</source>
      <translation>Zieht Zeilen und Zeit mit.</translation>
    </message>
    <message>
      <source>Double click</source>
      <translation>Doppelklick</translation>
    </message>
    <message>
      <source>Shows the whole clip.</source>
      <translation>Zeigt den ganzen Clip.</translation>
    </message>
    <message>
      <source>Click or drag in the upper lane</source>
      <translation>Klick oder Ziehen in der oberen Bahn</translation>
    </message>
    <message>
      <source>Goes to that frame.</source>
      <translation>Geht zu diesem Bild.</translation>
    </message>
    <message>
      <source>Drag the bar, or an end of it</source>
      <translation>Den Balken oder eines seiner Enden ziehen</translation>
    </message>
    <message>
      <source>Scrolls in time, or zooms.</source>
      <translation>Rollt in der Zeit oder zoomt.</translation>
    </message>
    <message>
      <source>Drag a diamond of x or y</source>
      <translation>Eine Raute von x oder y ziehen</translation>
    </message>
    <message>
      <source>Moves that key.</source>
      <translation>Verschiebt diesen Schlüssel.</translation>
    </message>
    <message>
      <source>Drag, or wheel</source>
      <translation>Ziehen, oder Rad</translation>
    </message>
    <message>
      <source>Moves and zooms the curve; a double click shows all of it.</source>
      <translation>Verschiebt und vergrößert die Kurve; ein Doppelklick zeigt sie ganz.</translation>
    </message>
    <message>
      <source>Goes to the frame of that patch.</source>
      <translation>Geht zum Bild dieses Ausschnitts.</translation>
    </message>
    <message>
      <source>In this step: {n} {title}</source>
      <translation>In diesem Schritt: {n} {title}</translation>
    </message>
    <message>
      <source>(no key)</source>
      <translation>(keine Taste)</translation>
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
      <source>Cut out</source>
      <translation>Ausschneiden</translation>
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
      <source>partly hidden most of the time</source>
      <translation>meistens teilweise verdeckt</translation>
    </message>
    <message>
      <source>{n} frames have no masks: Follow it carries the selected one on.</source>
      <translation>{n} Bilder haben keine Masken: „Verfolgen“ führt die gewählte weiter.</translation>
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
      <source>Pixels per frame at 1080 lines, against the background</source>
      <translation>Pixel je Bild bei 1080 Zeilen, gegen den Hintergrund</translation>
    </message>
    <message>
      <source>Share of the frames with masks in which it is seen; of those, in which it is partly hidden</source>
      <translation>Anteil der Bilder mit Masken, in denen es zu sehen ist; davon die, in denen es teilweise verdeckt ist</translation>
    </message>
    <message>
      <source>Candidate objects</source>
      <translation>Mögliche Objekte</translation>
    </message>
    <message>
      <source>Reason for leaving it out</source>
      <translation>Grund für das Weglassen</translation>
    </message>
    <message>
      <source>What is cut out</source>
      <translation>Was ausgeschnitten wird</translation>
    </message>
    <message>
      <source>A correction changes what you point at, and goes on from frame to frame until the mask agrees with it.</source>
      <translation>Eine Korrektur ändert, worauf Sie zeigen, und geht von Bild zu Bild weiter, bis die Maske damit übereinstimmt.</translation>
    </message>
    <message>
      <source>Say why it is left out.</source>
      <translation>Sagen Sie, warum es weggelassen wird.</translation>
    </message>
    <message>
      <source>size</source>
      <translation>Größe</translation>
    </message>
    <message>
      <source>speed</source>
      <translation>Tempo</translation>
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
      <source>Makes a new object</source>
      <translation>Macht ein neues Objekt</translation>
    </message>
    <message>
      <source>Puts the selected object's mask right</source>
      <translation>Berichtigt die Maske des gewählten Objekts</translation>
    </message>
    <message>
      <source>Draws the selected object's mask anew</source>
      <translation>Zeichnet die Maske des gewählten Objekts neu</translation>
    </message>
    <message>
      <source>An object needs a name.</source>
      <translation>Ein Objekt braucht einen Namen.</translation>
    </message>
    <message>
      <source>{n} of at most {most} objects chosen.</source>
      <translation>{n} von höchstens {most} Objekten gewählt.</translation>
    </message>
    <message>
      <source>There are {n} objects already; reject one first.</source>
      <translation>Es sind schon {n} Objekte; verwerfen Sie erst eines.</translation>
    </message>
    <message>
      <source>Names have {n} characters at most.</source>
      <translation>Namen haben höchstens {n} Zeichen.</translation>
    </message>
    <message>
      <source>{n} tracks of {name} are put aside; they come back if you choose it again.</source>
      <translation>{n} Spuren von {name} sind beiseitegelegt; sie kommen zurück, wenn es wieder gewählt wird.</translation>
    </message>
    <message>
      <source>Pictures were changed</source>
      <translation>Bilder wurden geändert</translation>
    </message>
    <message>
      <source>Go on</source>
      <translation>Weiter</translation>
    </message>
    <message>
      <source>{n} of {all} pictures are not those that were annotated: frames {frames}. Your work is all there. Put the old pictures back, or look at these frames again.</source>
      <translation>{n} von {all} Bildern sind nicht die, die annotiert wurden: Bilder {frames}. Ihre Arbeit ist vollständig da. Legen Sie die alten Bilder zurück oder sehen Sie diese Bilder noch einmal an.</translation>
    </message>
    <message>
      <source>These are right now</source>
      <translation>Diese gelten jetzt</translation>
    </message>
    <message>
      <source>The project takes these pictures for its own and does not warn again.</source>
      <translation>Das Projekt nimmt diese Bilder als die seinen und warnt nicht noch einmal.</translation>
    </message>
    <message>
      <source>{first} to {last}</source>
      <translation>{first} bis {last}</translation>
    </message>
    <message>
      <source>All points are placed. Seed the tracks now (Ctrl+G).</source>
      <translation>Alle Punkte sind gesetzt. Verfolgen Sie sie jetzt (Strg+G).</translation>
    </message>
    <message>
      <source>The point has no place in this frame.</source>
      <translation>Der Punkt hat in diesem Bild keinen Ort.</translation>
    </message>
    <message>
      <source>A point is being dragged: let it go first, or press Esc.</source>
      <translation>Ein Punkt wird gezogen: erst loslassen, oder Esc drücken.</translation>
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
      <translation>Was ein Zug über die Zeitübersicht malt</translation>
    </message>
    <message>
      <source>Order of the rows</source>
      <translation>Reihenfolge der Zeilen</translation>
    </message>
    <message>
      <source>Order of the rows of the dope sheet</source>
      <translation>Reihenfolge der Zeilen der Zeitübersicht</translation>
    </message>
    <message>
      <source>Speed</source>
      <translation>Tempo</translation>
    </message>
    <message>
      <source>Signs of the dope sheet</source>
      <translation>Zeichen der Zeitübersicht</translation>
    </message>
    <message>
      <source>What the signs mean, and what the mouse does</source>
      <translation>Was die Zeichen bedeuten, und was die Maus tut</translation>
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
      <source>nothing</source>
      <translation>nichts</translation>
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
      <source>scene</source>
      <translation>Szene</translation>
    </message>
    <message>
      <source>file</source>
      <translation>Datei</translation>
    </message>
    <message>
      <source>note about this track</source>
      <translation>Notiz zu dieser Spur</translation>
    </message>
    <message>
      <source>Queue: {n} of {m} left (N goes to the next)</source>
      <translation>Liste: noch {n} von {m} (N geht zur nächsten)</translation>
    </message>
    <message>
      <source>; the worst {n} are listed</source>
      <translation>; gezeigt sind die schlimmsten {n}</translation>
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
      <source>key</source>
      <translation>Schlüssel</translation>
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
      <source>frame {a}</source>
      <translation>Bild {a}</translation>
    </message>
    <message>
      <source>frames {a} to {b}</source>
      <translation>Bilder {a} bis {b}</translation>
    </message>
    <message>
      <source>A track came back from the review.</source>
      <translation>Eine Spur kam aus der Prüfung zurück.</translation>
    </message>
    <message>
      <source>a reviewer</source>
      <translation>der Prüfung</translation>
    </message>
    <message>
      <source>Sent back by {who}, round {n}: {reason}, {place}.</source>
      <translation>Von {who} zurückgegeben, Runde {n}: {reason}, {place}.</translation>
    </message>
    <message>
      <source>sent back by {who}: {reason}</source>
      <translation>von {who} zurückgegeben: {reason}</translation>
    </message>
    <message>
      <source>Fixed</source>
      <translation>Behoben</translation>
    </message>
    <message>
      <source>The point that is active was worked on and goes back to the reviewer.</source>
      <translation>Der gewählte Punkt wurde bearbeitet und geht an die Prüfung zurück.</translation>
    </message>
    <message>
      <source>{n} tracks came back from the review.</source>
      <translation>{n} Spuren kamen aus der Prüfung zurück.</translation>
    </message>
    <message>
      <source>N goes there first.</source>
      <translation>N geht zuerst dorthin.</translation>
    </message>
    <message>
      <source>Yours</source>
      <translation>Ihre</translation>
    </message>
    <message>
      <source>for {name}</source>
      <translation>für {name}</translation>
    </message>
    <message>
      <source> and {n} more</source>
      <translation> und {n} weitere</translation>
    </message>
    <message>
      <source>fixed: {said}</source>
      <translation>behoben: {said}</translation>
    </message>
    <message>
      <source>No tracks yet.</source>
      <translation>Noch keine Spuren.</translation>
    </message>
    <message>
      <source>Stands beside what you do from now on; what was done before keeps its name.</source>
      <translation>Steht bei allem, was Sie ab jetzt tun; was vorher geschah, behält seinen Namen.</translation>
    </message>
    <message>
      <source>Under which name do you decide? It is asked once on this machine.</source>
      <translation>Unter welchem Namen entscheiden Sie? Das wird auf diesem Rechner nur einmal gefragt.</translation>
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
      <source>Approved: {point}.</source>
      <translation>Freigegeben: {point}.</translation>
    </message>
    <message>
      <source>Rejected: {point}.</source>
      <translation>Verworfen: {point}.</translation>
    </message>
    <message>
      <source>What is wrong</source>
      <translation>Was stimmt nicht</translation>
    </message>
    <message>
      <source>It is your own track.</source>
      <translation>Es ist Ihre eigene Spur.</translation>
    </message>
    <message>
      <source>Approved by {who}.</source>
      <translation>Freigegeben von {who}.</translation>
    </message>
    <message>
      <source>Rejected by {who}.</source>
      <translation>Verworfen von {who}.</translation>
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
      <source>It is your own track: let another person look at it too.</source>
      <translation>Es ist Ihre eigene Spur: lassen Sie auch jemand anderen darauf sehen.</translation>
    </message>
    <message>
      <source>Every track is decided: the clip is closed.</source>
      <translation>Über jede Spur ist entschieden: der Clip ist abgeschlossen.</translation>
    </message>
    <message>
      <source>Reviewer</source>
      <translation>Prüfer</translation>
    </message>
    <message>
      <source>Annotated by {name}.</source>
      <translation>Annotiert von {name}.</translation>
    </message>
    <message>
      <source>The clip is closed: {parts}. Returning or unlocking a track opens it again.</source>
      <translation>Der Clip ist abgeschlossen: {parts}. Eine Spur zurückzugeben oder zu entsperren öffnet ihn wieder.</translation>
    </message>
    <message>
      <source>Returned to {name}: {reason}.</source>
      <translation>An {name} zurückgegeben: {reason}.</translation>
    </message>
    <message>
      <source>The annotator's note: {note}</source>
      <translation>Notiz zur Spur: {note}</translation>
    </message>
    <message>
      <source>its annotator</source>
      <translation>ihren Annotator</translation>
    </message>
    <message>
      <source>frame {a}; [ and ] mark more</source>
      <translation>Bild {a}; [ und ] markieren mehr</translation>
    </message>
    <message>
      <source>The system ended the optimisation; memory may have run out. Close other programs.</source>
      <translation>Das System hat die Optimierung beendet; vielleicht reichte der Speicher nicht. Schließen Sie andere Programme.</translation>
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
      <source>npz file</source>
      <translation>npz-Datei</translation>
    </message>
    <message>
      <source>File</source>
      <translation>Datei</translation>
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
      <source>the last scene of this project, at once</source>
      <translation>die letzte Szene dieses Projekts, sofort</translation>
    </message>
    <message>
      <source>CoTracker's licence has to be agreed to first.</source>
      <translation>Der Lizenz von CoTracker muss zuerst zugestimmt werden.</translation>
    </message>
    <message>
      <source>the scene on show in Watch, at once</source>
      <translation>die in Ansehen gezeigte Szene, sofort</translation>
    </message>
    <message>
      <source>Place points first.</source>
      <translation>Setzen Sie zuerst Punkte.</translation>
    </message>
    <message>
      <source>Optimising; ready in about {m} min. You can close this to cancel.</source>
      <translation>Es wird optimiert; fertig in etwa {m} min. Schließen bricht ab.</translation>
    </message>
    <message>
      <source>{n} min of optimising, ready in about {m} min</source>
      <translation>{n} min optimieren, fertig in etwa {m} min</translation>
    </message>
    <message>
      <source>{percent} % – {gone} so far, {left} to go</source>
      <translation>{percent} % – {gone} bisher, noch {left}</translation>
    </message>
    <message>
      <source>a moment</source>
      <translation>einen Augenblick</translation>
    </message>
    <message>
      <source>{points} points in {frames} frames: {time}, by what this machine needed before.</source>
      <translation>{points} Punkte in {frames} Bildern: {time}, nach dem, was dieser Rechner zuvor brauchte.</translation>
    </message>
    <message>
      <source>{points} points in {frames} frames: {time}, a guess; it has not run on this machine yet.</source>
      <translation>{points} Punkte in {frames} Bildern: {time}, geschätzt; auf diesem Rechner lief es noch nicht.</translation>
    </message>
    <message>
      <source>about {n} min</source>
      <translation>etwa {n} min</translation>
    </message>
    <message>
      <source>about {n} s</source>
      <translation>etwa {n} s</translation>
    </message>
    <message>
      <source>{percent} % – {gone} so far, longer than expected</source>
      <translation>{percent} % – {gone} bisher, länger als erwartet</translation>
    </message>
    <message>
      <source>a folder of mine</source>
      <translation>ein eigener Ordner</translation>
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
      <source>At once</source>
      <translation>Auf einmal</translation>
    </message>
    <message>
      <source>Memory</source>
      <translation>Speicher</translation>
    </message>
    <message>
      <source>Its licence: CC BY-NC 4.0…</source>
      <translation>Ihre Lizenz: CC BY-NC 4.0…</translation>
    </message>
    <message>
      <source> frames</source>
      <translation> Bilder</translation>
    </message>
    <message>
      <source> GiB</source>
      <translation> GiB</translation>
    </message>
    <message>
      <source>{name}, downloaded by torch.hub</source>
      <translation>{name}, von torch.hub geladen</translation>
    </message>
    <message>
      <source>{n} of {m} tracks are seeded. Nothing was found for {names}.</source>
      <translation>{n} von {m} Spuren sind vorgeschlagen. Nichts gefunden wurde für {names}.</translation>
    </message>
    <message>
      <source>Nothing was found for {names}.</source>
      <translation>Nichts gefunden wurde für {names}.</translation>
    </message>
    <message>
      <source>Without a mask, so left out: {names}.</source>
      <translation>Ohne Maske und darum ausgelassen: {names}.</translation>
    </message>
    <message>
      <source>{n} tracks are seeded.</source>
      <translation>{n} Spuren haben nun einen Vorschlag.</translation>
    </message>
    <message>
      <source>There is no place to go to that way.</source>
      <translation>Dorthin gibt es keine Stelle mehr.</translation>
    </message>
    <message>
      <source>There now, after: {title}. The history leads back.</source>
      <translation>Jetzt dort, nach: {title}. Der Verlauf führt zurück.</translation>
    </message>
    <message>
      <source>Nothing more to take back or do again.</source>
      <translation>Nichts mehr zurückzunehmen oder zu wiederholen.</translation>
    </message>
    <message>
      <source>not annotated</source>
      <translation>nicht annotiert</translation>
    </message>
    <message>
      <source>paler: the tracker was less sure</source>
      <translation>blasser: der Tracker war weniger sicher</translation>
    </message>
    <message>
      <source>suspicious, the redder the more</source>
      <translation>verdächtig, je röter desto mehr</translation>
    </message>
    <message>
      <source>marked as uncertain</source>
      <translation>als unsicher markiert</translation>
    </message>
    <message>
      <source>key: a person placed the point</source>
      <translation>Schlüssel: ein Mensch hat den Punkt gesetzt</translation>
    </message>
    <message>
      <source>between two keys: filled by a tracker</source>
      <translation>zwischen zwei Schlüsseln: von einem Tracker gefüllt</translation>
    </message>
    <message>
      <source>filled by a straight line</source>
      <translation>durch eine gerade Linie gefüllt</translation>
    </message>
    <message>
      <source>held where the first key is</source>
      <translation>gehalten, wo der erste Schlüssel ist</translation>
    </message>
    <message>
      <source>sent back by a reviewer</source>
      <translation>aus der Prüfung zurückgegeben</translation>
    </message>
    <message>
      <source>frame of the stride</source>
      <translation>Bild der Schrittweite</translation>
    </message>
    <message>
      <source>frame of the stride in which every point is accepted</source>
      <translation>Bild der Schrittweite, in dem jeder Punkt angenommen ist</translation>
    </message>
    <message>
      <source>run marked by [ and ]</source>
      <translation>mit [ und ] markierte Strecke</translation>
    </message>
    <message>
      <source>frames that are ready to be shown</source>
      <translation>Bilder, die bereitstehen</translation>
    </message>
    <message>
      <source>Zoom to this segment</source>
      <translation>Auf diesen Abschnitt zoomen</translation>
    </message>
    <message>
      <source>Segment filled by</source>
      <translation>Abschnitt gefüllt durch</translation>
    </message>
    <message>
      <source>Go to frame {n}</source>
      <translation>Zu Bild {n}</translation>
    </message>
    <message>
      <source>Frames {a} to {b} are</source>
      <translation>Bilder {a} bis {b} sind</translation>
    </message>
    <message>
      <source>Frame {n} is</source>
      <translation>Bild {n} ist</translation>
    </message>
    <message>
      <source>rows by object</source>
      <translation>Zeilen nach Objekt</translation>
    </message>
    <message>
      <source>Objects in their order, points by number</source>
      <translation>Objekte in ihrer Reihenfolge, Punkte nach Nummer</translation>
    </message>
    <message>
      <source>worst first</source>
      <translation>schlimmste zuerst</translation>
    </message>
    <message>
      <source>The most suspicious points first</source>
      <translation>Die verdächtigsten Punkte zuerst</translation>
    </message>
    <message>
      <source>fewest keys first</source>
      <translation>wenigste Schlüssel zuerst</translation>
    </message>
    <message>
      <source>Points with the fewest keys first; choose it again after more keys</source>
      <translation>Punkte mit den wenigsten Schlüsseln zuerst; nach weiteren Schlüsseln noch einmal wählen</translation>
    </message>
    <message>
      <source>longest gap first</source>
      <translation>längste Lücke zuerst</translation>
    </message>
    <message>
      <source>Points with the longest run without a key first; choose it again to sort anew</source>
      <translation>Punkte mit der längsten Strecke ohne Schlüssel zuerst; zum Neusortieren noch einmal wählen</translation>
    </message>
    <message>
      <source>between the keys {a} and {b}, filled by: {mode}</source>
      <translation>zwischen den Schlüsseln {a} und {b}, gefüllt durch: {mode}</translation>
    </message>
    <message>
      <source>{n} keys; review: {state}</source>
      <translation>{n} Schlüssel; Prüfung: {state}</translation>
    </message>
    <message>
      <source>suspicious ({n} of 9)</source>
      <translation>verdächtig ({n} von 9)</translation>
    </message>
    <message>
      <source>What speaks against the place of the active point in this frame, after what corrections taught: 0 nothing, 1 surely wrong. Together they make the suspicion.</source>
      <translation>Was in diesem Bild gegen den Ort des aktiven Punkts spricht, nach dem, was Korrekturen gelehrt haben: 0 nichts, 1 sicher falsch. Zusammen ergeben sie den Verdacht.</translation>
    </message>
    <message>
      <source>Nothing was judged yet.</source>
      <translation>Noch wurde nichts beurteilt.</translation>
    </message>
    <message>
      <source>Accept, go on</source>
      <translation>Bestätigen</translation>
    </message>
    <message>
      <source>Next open frame</source>
      <translation>Nächstes offene</translation>
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
      <source>Leave out</source>
      <translation>Weglassen</translation>
    </message>
    <message>
      <source>Box</source>
      <translation>Rechteck</translation>
    </message>
    <message>
      <source>On it</source>
      <translation>Darauf</translation>
    </message>
    <message>
      <source>Not this</source>
      <translation>Das nicht</translation>
    </message>
    <message>
      <source>Follow it</source>
      <translation>Verfolgen</translation>
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
      <source>From scene</source>
      <translation>Aus Szene</translation>
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
      <source>{n} objects are chosen, at most {most} are wanted.</source>
      <translation>{n} Objekte sind gewählt, höchstens {most} sollen es sein.</translation>
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
      <source>{n} points in frames of the stride are not accepted.</source>
      <translation>{n} Punkte in Bildern der Schrittweite sind nicht angenommen.</translation>
    </message>
    <message>
      <source>Draw</source>
      <translation>Zeichnen</translation>
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
      <source>{n} tracks wait for a decision.</source>
      <translation>{n} Spuren warten auf eine Entscheidung.</translation>
    </message>
    <message>
      <source>Sent back to their annotators: {n}.</source>
      <translation>Zur Nacharbeit zurückgegeben: {n}.</translation>
    </message>
    <message>
      <source>Every frame of the stride is accepted.</source>
      <translation>Jedes Bild der Schrittweite ist angenommen.</translation>
    </message>
    <message>
      <source>Nothing is open that way; {n} frames of the stride still are.</source>
      <translation>Dort ist nichts offen; {n} Bilder der Schrittweite sind es noch.</translation>
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
      <source>Places, states, names, numbers and flags come back when it is imported here.</source>
      <translation>Orte, Zustände, Namen, Nummern und Kennzeichen kommen zurück, wenn die Datei hier eingelesen wird.</translation>
    </message>
    <message>
      <source>Import tracks</source>
      <translation>Spuren importieren</translation>
    </message>
    <message>
      <source>Which video?</source>
      <translation>Welches Video?</translation>
    </message>
    <message>
      <source>Export tracks</source>
      <translation>Spuren exportieren</translation>
    </message>
    <message>
      <source>all but rejected ones ({n})</source>
      <translation>alle außer verworfenen ({n})</translation>
    </message>
    <message>
      <source>all ({n})</source>
      <translation>alle ({n})</translation>
    </message>
    <message>
      <source>approved ones only ({n})</source>
      <translation>nur freigegebene ({n})</translation>
    </message>
    <message>
      <source>Choose file …</source>
      <translation>Datei wählen …</translation>
    </message>
    <message>
      <source>Format</source>
      <translation>Format</translation>
    </message>
    <message>
      <source>Tracks</source>
      <translation>Spuren</translation>
    </message>
    <message>
      <source>Holds what is seen, no states: hidden points, flags and reviews do not come back.</source>
      <translation>Enthält, was sichtbar ist, keine Zustände: verdeckte Punkte, Kennzeichen und Prüfungen kommen nicht zurück.</translation>
    </message>
    <message>
      <source>Points beside the picture lie on its border for other programs; read here, they come back.</source>
      <translation>Punkte neben dem Bild liegen für andere Programme auf seinem Rand; hier eingelesen, kommen sie zurück.</translation>
    </message>
    <message>
      <source>{n} new objects</source>
      <translation>{n} neue Objekte</translation>
    </message>
    <message>
      <source>{n} locked ones left alone</source>
      <translation>{n} gesperrte unberührt</translation>
    </message>
    <message>
      <source>{n} places of yours kept</source>
      <translation>{n} eigene Orte behalten</translation>
    </message>
    <message>
      <source>{n} without any place left out</source>
      <translation>{n} ohne jeden Ort ausgelassen</translation>
    </message>
    <message>
      <source>{name} is a pickle. Opening one can run code; it is opened in a closed process that lets nothing through but arrays. Open it?</source>
      <translation>{name} ist ein Pickle. Beim Öffnen kann Code ausgeführt werden; ein abgeschlossener Prozess öffnet ihn und lässt nur Arrays durch. Öffnen?</translation>
    </message>
    <message>
      <source>Open a pickle?</source>
      <translation>Einen Pickle öffnen?</translation>
    </message>
    <message>
      <source>There is no such track to export.</source>
      <translation>Es gibt keine solche Spur zu exportieren.</translation>
    </message>
    <message>
      <source>All track files</source>
      <translation>Alle Dateien mit Spuren</translation>
    </message>
    <message>
      <source>Imported: {filled} points filled, {made} new</source>
      <translation>Eingelesen: {filled} Punkte gefüllt, {made} neue</translation>
    </message>
    <message>
      <source>Opening {name} …</source>
      <translation>{name} wird geöffnet …</translation>
    </message>
    <message>
      <source>{name} exists. Replace it?</source>
      <translation>{name} gibt es schon. Ersetzen?</translation>
    </message>
    <message>
      <source>Exported {n} tracks: {name}</source>
      <translation>{n} Spuren geschrieben: {name}</translation>
    </message>
    <message>
      <source>Nothing to import: </source>
      <translation>Nichts einzulesen: </translation>
    </message>
    <message>
      <source>{n} left out by their review</source>
      <translation>{n} wegen ihrer Prüfung ausgelassen</translation>
    </message>
    <message>
      <source>{n} visible points beside the picture lie at its border</source>
      <translation>{n} sichtbare Punkte neben dem Bild liegen auf seinem Rand</translation>
    </message>
    <message>
      <source>Timeline of the whole clip</source>
      <translation>Zeitleiste des ganzen Clips</translation>
    </message>
    <message>
      <source>The frames that the dope sheet and the graphs show.</source>
      <translation>Die Bilder, die Zeitübersicht und Kurven zeigen.</translation>
    </message>
    <message>
      <source>Drag the bar to scroll, its ends to zoom; a double click shows the whole clip.</source>
      <translation>Balken ziehen verschiebt, seine Enden ziehen zoomt; ein Doppelklick zeigt den ganzen Clip.</translation>
    </message>
    <message>
      <source>{a} to {b} of {n}</source>
      <translation>{a} bis {b} von {n}</translation>
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
      <source>No mask, or a wrong one? Draw a box around the object, click and scribble on it and beside it, then Cut out. It is followed through the clip.</source>
      <translation>Keine Maske, oder eine falsche? Ziehen Sie ein Rechteck um das Objekt, klicken und zeichnen Sie darauf und daneben, dann „Ausschneiden“. Es wird durch den Clip verfolgt.</translation>
    </message>
    <message>
      <source>Click five points on each object; the next one is chosen for you. Hold Z for the loupe, Ctrl and an arrow nudge by a quarter of a pixel.</source>
      <translation>Klicken Sie fünf Punkte auf jedem Objekt; der nächste wird von selbst gewählt. Z halten zeigt die Lupe, Strg und ein Pfeil rücken um ein Viertelpixel.</translation>
    </message>
    <message>
      <source>Try it: click on a corner of an object.</source>
      <translation>Probieren Sie es: auf eine Ecke eines Objekts klicken.</translation>
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
      <source>Try it: press Seed tracks, then Start. It takes some seconds.</source>
      <translation>Probieren Sie es: „Spuren vorschlagen“ drücken, dann „Start“. Es dauert einige Sekunden.</translation>
    </message>
    <message>
      <source>Fill: visible. Hatch: occluded. Diamond: your key. Red: doubtful. Click to go there, drag to paint a state.</source>
      <translation>Fläche: sichtbar. Schraffur: verdeckt. Raute: Ihr Schlüssel. Rot: zweifelhaft. Klicken geht dorthin, Ziehen malt einen Zustand.</translation>
    </message>
    <message>
      <source>Try it: click on another frame.</source>
      <translation>Probieren Sie es: auf ein anderes Bild klicken.</translation>
    </message>
    <message>
      <source>Enter accepts the points of a frame and goes on. Drag a point that is off: both segments beside it are solved again. Hold Q and step to paint occlusion.</source>
      <translation>Enter bestätigt die Punkte eines Bildes und geht weiter. Ziehen Sie einen falschen Punkt: Beide Abschnitte daneben werden neu gelöst. Q halten und weitergehen malt Verdeckung.</translation>
    </message>
    <message>
      <source>Try it: press Enter, or drag a point.</source>
      <translation>Probieren Sie es: Eingabe drücken oder einen Punkt ziehen.</translation>
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
      <source>Try it: press N.</source>
      <translation>Probieren Sie es: N drücken.</translation>
    </message>
    <message>
      <source>Somebody else approves each track, or returns it with a reason. Everything is stored as you work; Ctrl+Z takes back anything, even tomorrow.</source>
      <translation>Jemand anders gibt jede Spur frei oder mit einem Grund zurück. Alles wird beim Arbeiten gespeichert; Strg+Z nimmt alles zurück, auch morgen.</translation>
    </message>
    <message>
      <source>Try it: approve a track.</source>
      <translation>Probieren Sie es: eine Spur freigeben.</translation>
    </message>
    <message>
      <source>Try it: choose an object.</source>
      <translation>Probieren Sie es: ein Objekt wählen.</translation>
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
      <source>sent back once</source>
      <translation>einmal zurückgegeben</translation>
    </message>
    <message>
      <source>doubt</source>
      <translation>Zweifel</translation>
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
      <source>sent back {n} times</source>
      <translation>{n}-mal zurückgegeben</translation>
    </message>
    <message>
      <source>frame {n}, late</source>
      <translation>Bild {n}, spät</translation>
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
      <source>Place points where they are seen.</source>
      <translation>Setzen Sie Punkte dort, wo man sie sieht.</translation>
    </message>
    <message>
      <source>Seeding was cancelled; nothing was changed.</source>
      <translation>Das Vorschlagen wurde abgebrochen; nichts wurde geändert.</translation>
    </message>
    <message>
      <source>Place this point first.</source>
      <translation>Setzen Sie zuerst diesen Punkt.</translation>
    </message>
    <message>
      <source>This segment is filled by line or hold; I changes that.</source>
      <translation>Dieser Abschnitt wird durch Linie oder Halten gefüllt; I ändert das.</translation>
    </message>
    <message>
      <source>Seeding {n} tracks …</source>
      <translation>{n} Spuren werden vorgeschlagen …</translation>
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
      <source>Look at this point, then press Enter again.</source>
      <translation>Sehen Sie diesen Punkt an und drücken Sie noch einmal Enter.</translation>
    </message>
    <message>
      <source>Only between two keys there is a choice: place one on either side.</source>
      <translation>Nur zwischen zwei Schlüsseln gibt es eine Wahl: auf jede Seite einen setzen.</translation>
    </message>
    <message>
      <source>There is nothing to forget on that side of this frame.</source>
      <translation>Auf dieser Seite des Bildes gibt es nichts zu vergessen.</translation>
    </message>
    <message>
      <source>Unlocked: the track is no longer approved and waits for a decision again.</source>
      <translation>Entsperrt: die Spur ist nicht mehr freigegeben und wartet wieder auf eine Entscheidung.</translation>
    </message>
    <message>
      <source>{point} is fixed and goes back to {who}.</source>
      <translation>{point} ist behoben und geht an {who} zurück.</translation>
    </message>
    <message>
      <source>the reviewer</source>
      <translation>die Prüfung</translation>
    </message>
    <message>
      <source>This segment is filled by: {mode}</source>
      <translation>Dieser Abschnitt wird gefüllt durch: {mode}</translation>
    </message>
    <message>
      <source>{n} more came back.</source>
      <translation>{n} weitere kamen zurück.</translation>
    </message>
    <message>
      <source>Reading the clip …</source>
      <translation>Der Clip wird gelesen …</translation>
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
      <source>Other</source>
      <translation>Weitere</translation>
    </message>
    <message>
      <source>goes to the next point or field</source>
      <translation>geht zum nächsten Punkt oder Feld</translation>
    </message>
    <message>
      <source>goes to the point or field before</source>
      <translation>geht zum vorigen Punkt oder Feld</translation>
    </message>
    <message>
      <source>closes dialogs and puts tools away</source>
      <translation>schließt Dialoge und legt Werkzeuge weg</translation>
    </message>
    <message>
      <source>closes the window</source>
      <translation>schließt das Fenster</translation>
    </message>
    <message>
      <source>{key} begins with {taken}, which belongs to “{other}”.</source>
      <translation>{key} beginnt mit {taken}, das zu „{other}“ gehört.</translation>
    </message>
    <message>
      <source>{key} {does} everywhere and cannot be given away.</source>
      <translation>{key} {does}, und zwar überall, und kann nicht vergeben werden.</translation>
    </message>
    <message>
      <source>“{action}” acts as long as its key is held: it takes a single key, no sequence.</source>
      <translation>„{action}“ wirkt, solange die Taste gehalten wird: möglich ist eine einzelne Taste, keine Folge.</translation>
    </message>
    <message>
      <source>{key} belongs to “{other}”.</source>
      <translation>{key} gehört zu „{other}“.</translation>
    </message>
    <message>
      <source>{key} begins {taken} of “{other}”, which could not be reached any more.</source>
      <translation>Mit {key} beginnt {taken} von „{other}“, das dann nicht mehr erreichbar wäre.</translation>
    </message>
    <message>
      <source>Mouse and keys</source>
      <translation>Maus und Tasten</translation>
    </message>
    <message>
      <source>This step only</source>
      <translation>Nur dieser Schritt</translation>
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
      <source>Shortcuts and settings</source>
      <translation>Tasten und Einstellungen</translation>
    </message>
    <message>
      <source>The language changes when the app starts again.</source>
      <translation>Die Sprache wechselt beim nächsten Start der App.</translation>
    </message>
    <message>
      <source>Keys of the command</source>
      <translation>Tasten des Befehls</translation>
    </message>
    <message>
      <source>Take it over</source>
      <translation>Übernehmen</translation>
    </message>
    <message>
      <source>Import shortcuts</source>
      <translation>Tastenkürzel importieren</translation>
    </message>
    <message>
      <source>Export shortcuts</source>
      <translation>Tastenkürzel exportieren</translation>
    </message>
    <message>
      <source>Give mine up</source>
      <translation>Meine aufgeben</translation>
    </message>
    <message>
      <source>Replace the marked key</source>
      <translation>Markierte Taste ersetzen</translation>
    </message>
    <message>
      <source>Remove</source>
      <translation>Entfernen</translation>
    </message>
    <message>
      <source>As delivered</source>
      <translation>Wie geliefert</translation>
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
      <source>Mark a command first.</source>
      <translation>Zuerst einen Befehl markieren.</translation>
    </message>
    <message>
      <source>Press the new key in the field first.</source>
      <translation>Zuerst im Feld die neue Taste drücken.</translation>
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
      <source>The command has this key already.</source>
      <translation>Der Befehl hat diese Taste schon.</translation>
    </message>
    <message>
      <source>{n} commands of the file are not known here.</source>
      <translation>{n} Befehle der Datei sind hier nicht bekannt.</translation>
    </message>
    <message>
      <source>Keys of your own clash with {preset}: {names}.</source>
      <translation>Eigene Tasten vertragen sich nicht mit {preset}: {names}.</translation>
    </message>
    <message>
      <source>Taken from {name}.</source>
      <translation>Aus {name} übernommen.</translation>
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
      <source>Set</source>
      <translation>Setzen</translation>
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
      <source>Follow the annotated points</source>
      <translation>Den annotierten Punkten folgen</translation>
    </message>
    <message>
      <source>What people placed or accepted in this clip leads the scene.</source>
      <translation>Was Menschen in diesem Clip gesetzt oder angenommen haben, führt die Szene.</translation>
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
      <source>annotated</source>
      <translation>annotiert</translation>
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
      <source>All shortcuts</source>
      <translation>Alle Tasten</translation>
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
      <source>Next open frame of the stride</source>
      <translation>Nächstes offenes Bild der Schrittweite</translation>
    </message>
    <message>
      <source>Where not every point is accepted yet.</source>
      <translation>Wo noch nicht jeder Punkt angenommen ist.</translation>
    </message>
    <message>
      <source>Previous open frame of the stride</source>
      <translation>Voriges offenes Bild der Schrittweite</translation>
    </message>
    <message>
      <source>The same, backwards.</source>
      <translation>Dasselbe rückwärts.</translation>
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
      <source>On to where I came from</source>
      <translation>Wieder vor, woher ich kam</translation>
    </message>
    <message>
      <source>The other way after going back.</source>
      <translation>Nach dem Zurückgehen die andere Richtung.</translation>
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
      <source>Choose the object</source>
      <translation>Objekt wählen</translation>
    </message>
    <message>
      <source>Annotates the selected object.</source>
      <translation>Das gewählte Objekt wird annotiert.</translation>
    </message>
    <message>
      <source>Leave the object out</source>
      <translation>Objekt weglassen</translation>
    </message>
    <message>
      <source>For the reason that stands in the panel.</source>
      <translation>Aus dem Grund, der im Feld steht.</translation>
    </message>
    <message>
      <source>Earlier in the order</source>
      <translation>Früher in der Reihenfolge</translation>
    </message>
    <message>
      <source>The object and its colour come before others.</source>
      <translation>Das Objekt und seine Farbe kommen vor anderen.</translation>
    </message>
    <message>
      <source>Later in the order</source>
      <translation>Später in der Reihenfolge</translation>
    </message>
    <message>
      <source>The object comes after others.</source>
      <translation>Das Objekt kommt nach anderen.</translation>
    </message>
    <message>
      <source>Draw a box</source>
      <translation>Rechteck zeichnen</translation>
    </message>
    <message>
      <source>Draw on the object</source>
      <translation>Auf dem Objekt zeichnen</translation>
    </message>
    <message>
      <source>Strokes or clicks on what belongs to it.</source>
      <translation>Striche oder Klicks auf das, was dazugehört.</translation>
    </message>
    <message>
      <source>Draw beside the object</source>
      <translation>Neben dem Objekt zeichnen</translation>
    </message>
    <message>
      <source>Strokes on what is not part of it.</source>
      <translation>Striche auf das, was nicht dazugehört.</translation>
    </message>
    <message>
      <source>Makes a mask of what was drawn, and follows it through the clip.</source>
      <translation>Macht aus dem Gezeichneten eine Maske und folgt ihr durch den Clip.</translation>
    </message>
    <message>
      <source>Follow the mask through the clip</source>
      <translation>Maske durch den Clip verfolgen</translation>
    </message>
    <message>
      <source>Into frames for which the clip has no masks.</source>
      <translation>In Bilder, für die der Clip keine Masken hat.</translation>
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
      <source>Not annotated</source>
      <translation>Nicht annotiert</translation>
    </message>
    <message>
      <source>Forgets the place; hold and step to paint a gap.</source>
      <translation>Vergisst den Ort; halten und weitergehen malt eine Lücke.</translation>
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
      <source>Optimises a scene that follows what you placed and takes its tracks; begins at once and tells how long it takes.</source>
      <translation>Optimiert eine Szene, die dem Gesetzten folgt, und nimmt ihre Spuren; beginnt sofort und sagt, wie lange es dauert.</translation>
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
      <source>Track on to the next key</source>
      <translation>Weiter bis zum nächsten Schlüssel verfolgen</translation>
    </message>
    <message>
      <source>Solves from here to the next key.</source>
      <translation>Löst von hier bis zum nächsten Schlüssel.</translation>
    </message>
    <message>
      <source>Track back to the key before</source>
      <translation>Zurück bis zum Schlüssel davor verfolgen</translation>
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
      <source>In the marked frames, or from here on.</source>
      <translation>In den markierten Bildern oder ab hier.</translation>
    </message>
    <message>
      <source>Split: from here on another point…</source>
      <translation>Teilen: ab hier ein anderer Punkt …</translation>
    </message>
    <message>
      <source>The rest becomes a point that is free.</source>
      <translation>Der Rest wird ein Punkt, der frei ist.</translation>
    </message>
    <message>
      <source>Join with another point…</source>
      <translation>Mit einem anderen Punkt verbinden …</translation>
    </message>
    <message>
      <source>Takes the frames of another track, which goes.</source>
      <translation>Übernimmt die Bilder einer anderen Spur, die dann weg ist.</translation>
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
      <source>Bring the point into view</source>
      <translation>Punkt in die Ansicht holen</translation>
    </message>
    <message>
      <source>The middle of the view, wherever the point is.</source>
      <translation>In die Mitte der Ansicht, wo auch immer der Punkt ist.</translation>
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
      <source>Zoom in on time</source>
      <translation>Zeit vergrößern</translation>
    </message>
    <message>
      <source>Fewer frames in dope sheet and graphs; there Ctrl+wheel does it too.</source>
      <translation>Weniger Bilder in Zeitübersicht und Kurven; dort tut es auch Strg+Rad.</translation>
    </message>
    <message>
      <source>Zoom out of time</source>
      <translation>Zeit verkleinern</translation>
    </message>
    <message>
      <source>More frames in dope sheet and graphs.</source>
      <translation>Mehr Bilder in Zeitübersicht und Kurven.</translation>
    </message>
    <message>
      <source>Whole clip in the dope sheet</source>
      <translation>Ganzer Clip in der Zeitübersicht</translation>
    </message>
    <message>
      <source>All frames; a double click there does it too.</source>
      <translation>Alle Bilder; dort tut es auch ein Doppelklick.</translation>
    </message>
    <message>
      <source>Order of rows</source>
      <translation>Reihenfolge der Zeilen</translation>
    </message>
    <message>
      <source>What they mean, and what the mouse does there.</source>
      <translation>Was sie bedeuten, und was die Maus dort tut.</translation>
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
      <source>History…</source>
      <translation>Verlauf…</translation>
    </message>
    <message>
      <source>All deeds, also those undone, named moments and other branches; goes to any of them.</source>
      <translation>Alles, was getan wurde, auch Zurückgenommenes, benannte Momente und andere Zweige; geht zu jedem davon.</translation>
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
      <source>Check the log</source>
      <translation>Protokoll prüfen</translation>
    </message>
    <message>
      <source>Whether anything in it was changed afterwards.</source>
      <translation>Ob darin nachträglich etwas geändert wurde.</translation>
    </message>
    <message>
      <source>CSV or JSON; names and times only with consent.</source>
      <translation>CSV oder JSON; Namen und Zeiten nur mit Einwilligung.</translation>
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
      <source>Save a copy of the project…</source>
      <translation>Kopie des Projekts speichern…</translation>
    </message>
    <message>
      <source>To hand it over, or to keep it elsewhere.</source>
      <translation>Zum Weitergeben oder um sie anderswo aufzubewahren.</translation>
    </message>
    <message>
      <source>Edits a project that another program had open, once that has left it.</source>
      <translation>Bearbeitet ein Projekt, das ein anderes Programm offen hatte, sobald dieses es verlassen hat.</translation>
    </message>
    <message>
      <source>Open a backup copy…</source>
      <translation>Sicherungskopie öffnen…</translation>
    </message>
    <message>
      <source>As a new project; this one stays as it is.</source>
      <translation>Als neues Projekt; dieses bleibt, wie es ist.</translation>
    </message>
    <message>
      <source>Show the project's folder</source>
      <translation>Ordner des Projekts zeigen</translation>
    </message>
    <message>
      <source>Where the project of this clip lies.</source>
      <translation>Wo das Projekt dieses Clips liegt.</translation>
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
      <source>Correct the selected mask</source>
      <translation>Gewählte Maske berichtigen</translation>
    </message>
    <message>
      <source>Step 1; what is drawn puts the object's mask right.</source>
      <translation>Schritt 1; was gezeichnet wird, berichtigt die Maske des Objekts.</translation>
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
      <source>motion</source>
      <translation>Bewegung</translation>
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
      <source>Merge {count} objects</source>
      <translation>{count} Objekte übernehmen</translation>
    </message>
    <message>
      <source>Merge {tracks} tracks and {objects} objects</source>
      <translation>{tracks} Spuren und {objects} Objekte übernehmen</translation>
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
      <source>New mask for {name}</source>
      <translation>Neue Maske für {name}</translation>
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
      <source>Exchange {one} and {other}, {frames}</source>
      <translation>{one} und {other} tauschen, {frames}</translation>
    </message>
    <message>
      <source>Split {one}: from {frame} on it is {other}</source>
      <translation>{one} teilen: ab {frame} ist es {other}</translation>
    </message>
    <message>
      <source>Join {other} to {one}</source>
      <translation>{other} mit {one} verbinden</translation>
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
      <source>Needs fix: {reason} ({name})</source>
      <translation>Nacharbeit nötig: {reason} ({name})</translation>
    </message>
    <message>
      <source>Reject: {name}</source>
      <translation>Verwerfen: {name}</translation>
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
    <message>
      <source>no track yet</source>
      <translation>noch keine Spur</translation>
    </message>
    <message>
      <source>nothing is annotated yet</source>
      <translation>noch nichts annotiert</translation>
    </message>
    <message>
      <source>nothing was reviewed yet</source>
      <translation>noch nichts geprüft</translation>
    </message>
    <message>
      <source>times were taken out of this copy</source>
      <translation>Zeiten wurden aus dieser Kopie entfernt</translation>
    </message>
    <message>
      <source>needs {count} accepted places and {seconds} s of work</source>
      <translation>braucht {count} angenommene Stellen und {seconds} s Arbeit</translation>
    </message>
    <message>
      <source>visible ×{count}</source>
      <translation>sichtbar ×{count}</translation>
    </message>
    <message>
      <source>occluded ×{count}</source>
      <translation>verdeckt ×{count}</translation>
    </message>
    <message>
      <source>out of view ×{count}</source>
      <translation>außer Sicht ×{count}</translation>
    </message>
    <message>
      <source>not annotated ×{count}</source>
      <translation>nicht annotiert ×{count}</translation>
    </message>
    <message>
      <source>keys: {count}</source>
      <translation>Schlüssel: {count}</translation>
    </message>
    <message>
      <source>accepted: {count}</source>
      <translation>angenommen: {count}</translation>
    </message>
    <message>
      <source>uncertain: {count}</source>
      <translation>unsicher: {count}</translation>
    </message>
    <message>
      <source>filled by the tracker</source>
      <translation>vom Tracker gefüllt</translation>
    </message>
    <message>
      <source>filled by a line</source>
      <translation>als Linie gefüllt</translation>
    </message>
    <message>
      <source>held until the next key</source>
      <translation>gehalten bis zum nächsten Schlüssel</translation>
    </message>
    <message>
      <source>x {x:.1f} y {y:.1f}</source>
      <translation>x {x:.1f} y {y:.1f}</translation>
    </message>
    <message>
      <source>moved by {pixels:.1f} px</source>
      <translation>um {pixels:.1f} px verschoben</translation>
    </message>
    <message>
      <source>moved by up to {pixels:.1f} px</source>
      <translation>um bis zu {pixels:.1f} px verschoben</translation>
    </message>
    <message>
      <source>made</source>
      <translation>angelegt</translation>
    </message>
    <message>
      <source>deleted</source>
      <translation>gelöscht</translation>
    </message>
    <message>
      <source>called “{name}”</source>
      <translation>heißt „{name}“</translation>
    </message>
    <message>
      <source>note “{name}”</source>
      <translation>Notiz „{name}“</translation>
    </message>
    <message>
      <source>the reviewer says “{name}”</source>
      <translation>Prüfung sagt „{name}“</translation>
    </message>
    <message>
      <source>annotator “{name}”</source>
      <translation>annotiert von „{name}“</translation>
    </message>
    <message>
      <source>reviewer “{name}”</source>
      <translation>geprüft von „{name}“</translation>
    </message>
    <message>
      <source>{what} “{name}”</source>
      <translation>{what} „{name}“</translation>
    </message>
    <message>
      <source>not locked</source>
      <translation>nicht gesperrt</translation>
    </message>
    <message>
      <source>place {count} in the order</source>
      <translation>Platz {count} in der Reihenfolge</translation>
    </message>
    <message>
      <source>point number {count}</source>
      <translation>Punkt Nummer {count}</translation>
    </message>
    <message>
      <source>mask drawn: no. {count}</source>
      <translation>gezeichnete Maske: Nr. {count}</translation>
    </message>
    <message>
      <source>times returned: {count}</source>
      <translation>zurückgegeben: {count}-mal</translation>
    </message>
    <message>
      <source>candidate</source>
      <translation>Kandidat</translation>
    </message>
    <message>
      <source>has {keys} keys, allowed are 1 to {value}</source>
      <translation>hat {keys} Schlüssel, erlaubt sind 1 bis {value}</translation>
    </message>
    <message>
      <source>key {value} holds no camera</source>
      <translation>Schlüssel {value} enthält keine Kamera</translation>
    </message>
    <message>
      <source>key {value} has a field of view, hold or scene time that cannot be</source>
      <translation>Schlüssel {value} hat ein Sichtfeld, eine Haltezeit oder Szenenzeit, die es nicht geben kann</translation>
    </message>
    <message>
      <source>key {value} comes before the one before it has ended</source>
      <translation>Schlüssel {value} kommt, bevor der vorige zu Ende ist</translation>
    </message>
    <message>
      <source>put the keys in order of time</source>
      <translation>ordnen Sie die Schlüssel nach der Zeit</translation>
    </message>
    <message>
      <source>is no camera path</source>
      <translation>ist kein Kamerapfad</translation>
    </message>
    <message>
      <source>export one as JSON to see how it looks</source>
      <translation>exportieren Sie einen als JSON, um zu sehen, wie er aussieht</translation>
    </message>
    <message>
      <source>holds {world_to_camera} cameras for {frames} frames</source>
      <translation>enthält {world_to_camera} Kameras für {frames} Bilder</translation>
    </message>
    <message>
      <source>give one camera per frame</source>
      <translation>geben Sie je Bild eine Kamera</translation>
    </message>
    <message>
      <source>the camera of frame {value} {fault}</source>
      <translation>die Kamera von Bild {value} {fault}</translation>
    </message>
    <message>
      <source>check world_to_camera and K</source>
      <translation>prüfen Sie world_to_camera und K</translation>
    </message>
    <message>
      <source>holds no valid depth (0 % of its values are finite and positive)</source>
      <translation>enthält keine gültige Tiefe (0 % der Werte sind endlich und positiv)</translation>
    </message>
    <message>
      <source>take the file away or use --ignore depth</source>
      <translation>nehmen Sie die Datei weg oder benutzen Sie --ignore depth</translation>
    </message>
    <message>
      <source>holds intrinsics {shape} and poses {shape_2}</source>
      <translation>enthält Intrinsik {shape} und Posen {shape_2}</translation>
    </message>
    <message>
      <source>store K as (3, 3) or (T, 3, 3) and world_to_camera as (T, 4, 4)</source>
      <translation>speichern Sie K als (3, 3) oder (T, 3, 3) und world_to_camera als (T, 4, 4)</translation>
    </message>
    <message>
      <source>is {shape} beside a flow of {shape_2}</source>
      <translation>ist {shape} neben einem Fluss von {shape_2}</translation>
    </message>
    <message>
      <source>give one value per pixel</source>
      <translation>geben Sie je Pixel einen Wert</translation>
    </message>
    <message>
      <source>has the shape {shape}</source>
      <translation>hat die Form {shape}</translation>
    </message>
    <message>
      <source>give (T, H, W)</source>
      <translation>geben Sie (T, H, W)</translation>
    </message>
    <message>
      <source>give (T, H, W, 2)</source>
      <translation>geben Sie (T, H, W, 2)</translation>
    </message>
    <message>
      <source>is stored as {dtype}</source>
      <translation>ist als {dtype} gespeichert</translation>
    </message>
    <message>
      <source>store floating point numbers</source>
      <translation>speichern Sie Gleitkommazahlen</translation>
    </message>
    <message>
      <source>holds {shape} frames for a clip of {total}</source>
      <translation>enthält {shape} Bilder für einen Clip von {total}</translation>
    </message>
    <message>
      <source>give one plane per frame</source>
      <translation>geben Sie je Bild eine Ebene</translation>
    </message>
    <message>
      <source>is {shape} x {shape_2}, another shape than the frames' {source_size} x {source_size_2}</source>
      <translation>ist {shape} x {shape_2}, eine andere Form als die der Bilder, {source_size} x {source_size_2}</translation>
    </message>
    <message>
      <source>give it in the frames' shape</source>
      <translation>geben Sie es in der Form der Bilder</translation>
    </message>
    <message>
      <source>is no direction</source>
      <translation>ist keine Richtung</translation>
    </message>
    <message>
      <source>store three numbers, not all zero</source>
      <translation>speichern Sie drei Zahlen, nicht alle null</translation>
    </message>
    <message>
      <source>is no (width, height)</source>
      <translation>ist kein Paar (Breite, Höhe)</translation>
    </message>
    <message>
      <source>store two positive numbers</source>
      <translation>speichern Sie zwei positive Zahlen</translation>
    </message>
    <message>
      <source>holds a pose that cannot be inverted</source>
      <translation>enthält eine Pose, die sich nicht umkehren lässt</translation>
    </message>
    <message>
      <source>check cam_c2w</source>
      <translation>prüfen Sie cam_c2w</translation>
    </message>
    <message>
      <source>cannot be read ({strerror})</source>
      <translation>kann nicht gelesen werden ({strerror})</translation>
    </message>
    <message>
      <source>check the file</source>
      <translation>prüfen Sie die Datei</translation>
    </message>
    <message>
      <source>the short side is {short_side} pixels</source>
      <translation>die kurze Seite ist {short_side} Pixel</translation>
    </message>
    <message>
      <source>give 1 or more</source>
      <translation>geben Sie 1 oder mehr</translation>
    </message>
    <message>
      <source>cannot ignore '{unknown}'</source>
      <translation>„{unknown}“ kann nicht ignoriert werden</translation>
    </message>
    <message>
      <source>is {shape} x {shape_2} but the frames are {source_size} x {source_size_2}</source>
      <translation>ist {shape} x {shape_2}, aber die Bilder sind {source_size} x {source_size_2}</translation>
    </message>
    <message>
      <source>make them the same size or use --ignore background</source>
      <translation>machen Sie sie gleich groß oder benutzen Sie --ignore background</translation>
    </message>
    <message>
      <source>is {shape} x {shape_2} but the first frame is {size} x {size_2}</source>
      <translation>ist {shape} x {shape_2}, aber das erste Bild ist {size} x {size_2}</translation>
    </message>
    <message>
      <source>make all frames the same size</source>
      <translation>machen Sie alle Bilder gleich groß</translation>
    </message>
    <message>
      <source>frame {index} cannot be decoded</source>
      <translation>Bild {index} kann nicht gelesen werden</translation>
    </message>
    <message>
      <source>convert it to H.264 in mp4</source>
      <translation>wandeln Sie es in H.264 in mp4 um</translation>
    </message>
    <message>
      <source>holds positions {shape} for a clip of {total} frames</source>
      <translation>enthält Orte {shape} für einen Clip von {total} Bildern</translation>
    </message>
    <message>
      <source>store (points, frames, 2)</source>
      <translation>speichern Sie (Punkte, Bilder, 2)</translation>
    </message>
    <message>
      <source>holds states other than 0 to 3</source>
      <translation>enthält andere Zustände als 0 bis 3</translation>
    </message>
    <message>
      <source>use 0 none, 1 visible, 2 occluded, 3 out of view</source>
      <translation>benutzen Sie 0 keiner, 1 sichtbar, 2 verdeckt, 3 außerhalb des Bildes</translation>
    </message>
    <message>
      <source>store (width, height) in pixels</source>
      <translation>speichern Sie (Breite, Höhe) in Pixeln</translation>
    </message>
    <message>
      <source>is {dtype} of shape {shape}, wanted are numbers with {wanted}</source>
      <translation>ist {dtype} der Form {shape}, verlangt sind Zahlen mit {wanted}</translation>
    </message>
    <message>
      <source>store it in that shape</source>
      <translation>speichern Sie es in dieser Form</translation>
    </message>
    <message>
      <source>is a mask in colours, and ({value}, {value_2}, {value_3}) is no colour of the DAVIS palette</source>
      <translation>ist eine farbige Maske, und ({value}, {value_2}, {value_3}) ist keine Farbe der DAVIS-Palette</translation>
    </message>
    <message>
      <source>store object ids as a palette PNG</source>
      <translation>speichern Sie Objektnummern als PNG mit Palette</translation>
    </message>
    <message>
      <source>is a JPEG file that is cut short</source>
      <translation>ist eine abgeschnittene JPEG-Datei</translation>
    </message>
    <message>
      <source>copy the file again</source>
      <translation>kopieren Sie die Datei noch einmal</translation>
    </message>
    <message>
      <source>is an image that cannot be decoded</source>
      <translation>ist ein Bild, das nicht gelesen werden kann</translation>
    </message>
    <message>
      <source>write the file again</source>
      <translation>schreiben Sie die Datei neu</translation>
    </message>
    <message>
      <source>is not a PNG, and a mask must be stored without loss</source>
      <translation>ist kein PNG, und eine Maske muss verlustfrei gespeichert sein</translation>
    </message>
    <message>
      <source>write a PNG</source>
      <translation>schreiben Sie ein PNG</translation>
    </message>
    <message>
      <source>holds the object id {max}, allowed are ids up to 254</source>
      <translation>enthält die Objektnummer {max}, erlaubt sind Nummern bis 254</translation>
    </message>
    <message>
      <source>number the objects 1, 2, 3</source>
      <translation>nummerieren Sie die Objekte 1, 2, 3</translation>
    </message>
    <message>
      <source>is a WebP file that is cut short</source>
      <translation>ist eine abgeschnittene WebP-Datei</translation>
    </message>
    <message>
      <source>check the path</source>
      <translation>prüfen Sie den Pfad</translation>
    </message>
    <message>
      <source>is not an image ({data})</source>
      <translation>ist kein Bild ({data})</translation>
    </message>
    <message>
      <source>check the file's name</source>
      <translation>prüfen Sie den Namen der Datei</translation>
    </message>
    <message>
      <source>is no clip ({no} extension)</source>
      <translation>ist kein Clip ({no} als Endung)</translation>
    </message>
    <message>
      <source>give a folder of frames, an image or a video</source>
      <translation>geben Sie einen Ordner mit Bildern, ein Bild oder ein Video</translation>
    </message>
    <message>
      <source>there is no such file or folder</source>
      <translation>es gibt keine solche Datei und keinen solchen Ordner</translation>
    </message>
    <message>
      <source>holds no frames</source>
      <translation>enthält keine Bilder</translation>
    </message>
    <message>
      <source>give a folder of images, an image or a video</source>
      <translation>geben Sie einen Ordner mit Bildern, ein Bild oder ein Video</translation>
    </message>
    <message>
      <source>put images ({join}) there</source>
      <translation>legen Sie Bilder ({join}) hinein</translation>
    </message>
    <message>
      <source>holds {clips} clips ({shown}, ...)</source>
      <translation>enthält {clips} Clips ({shown}, ...)</translation>
    </message>
    <message>
      <source>give one of them, such as {clips}</source>
      <translation>geben Sie einen davon, etwa {clips}</translation>
    </message>
    <message>
      <source>holds {videos} videos</source>
      <translation>enthält {videos} Videos</translation>
    </message>
    <message>
      <source>give one of them</source>
      <translation>geben Sie eines davon</translation>
    </message>
    <message>
      <source>holds {clips} folders with frames</source>
      <translation>enthält {clips} Ordner mit Bildern</translation>
    </message>
    <message>
      <source>holds both {name} and {name_2}</source>
      <translation>enthält sowohl {name} als auch {name_2}</translation>
    </message>
    <message>
      <source>keep frames and masks in folders of their own</source>
      <translation>halten Sie Bilder und Masken in eigenen Ordnern</translation>
    </message>
    <message>
      <source>holds {value} {unit}, allowed are {most}</source>
      <translation>enthält {value} {unit}, erlaubt sind {most}</translation>
    </message>
    <message>
      <source>declares an image of {width} x {height} pixels</source>
      <translation>gibt ein Bild von {width} x {height} Pixeln an</translation>
    </message>
    <message>
      <source>the clip has no masks</source>
      <translation>der Clip hat keine Masken</translation>
    </message>
    <message>
      <source>its arrays do not fit together</source>
      <translation>die Arrays darin passen nicht zusammen</translation>
    </message>
    <message>
      <source>write it with genmojo-studio</source>
      <translation>schreiben Sie sie mit genmojo-studio</translation>
    </message>
    <message>
      <source>holds none of the clip's frames</source>
      <translation>enthält keines der Bilder des Clips</translation>
    </message>
    <message>
      <source>give the masks of this clip</source>
      <translation>geben Sie die Masken dieses Clips</translation>
    </message>
    <message>
      <source>holds a background mask (000) but no object</source>
      <translation>enthält eine Maske des Hintergrunds (000), aber kein Objekt</translation>
    </message>
    <message>
      <source>add one folder per object: 001, 002</source>
      <translation>legen Sie je Objekt einen Ordner an: 001, 002</translation>
    </message>
    <message>
      <source>is named by an object id above 254</source>
      <translation>ist nach einer Objektnummer über 254 benannt</translation>
    </message>
    <message>
      <source>number objects from 001</source>
      <translation>nummerieren Sie die Objekte ab 001</translation>
    </message>
    <message>
      <source>has masks numbered {found} to {found_2} but frames numbered {numbers} to {numbers_2}</source>
      <translation>hat Masken mit den Nummern {found} bis {found_2}, aber Bilder mit den Nummern {numbers} bis {numbers_2}</translation>
    </message>
    <message>
      <source>name masks like their frames</source>
      <translation>benennen Sie Masken wie ihre Bilder</translation>
    </message>
    <message>
      <source>the mask is {shape} x {shape_2} but its frame is {size} x {size_2}</source>
      <translation>die Maske ist {shape} x {shape_2}, aber ihr Bild ist {size} x {size_2}</translation>
    </message>
    <message>
      <source>make them the same size</source>
      <translation>machen Sie sie gleich groß</translation>
    </message>
    <message>
      <source>no object is visible in any frame (all masks are background)</source>
      <translation>in keinem Bild ist ein Objekt sichtbar (alle Masken sind Hintergrund)</translation>
    </message>
    <message>
      <source>mark at least one object, or take the masks away</source>
      <translation>zeichnen Sie mindestens ein Objekt ein, oder nehmen Sie die Masken weg</translation>
    </message>
    <message>
      <source>is no JSON object</source>
      <translation>ist kein JSON-Objekt</translation>
    </message>
    <message>
      <source>correct it or take it away</source>
      <translation>berichtigen Sie es oder nehmen Sie es weg</translation>
    </message>
    <message>
      <source>the pixel aspect is {value}, allowed is {low:g} to {high:g}</source>
      <translation>das Seitenverhältnis der Pixel ist {value}, erlaubt ist {low:g} bis {high:g}</translation>
    </message>
    <message>
      <source>{key} is {value}, allowed is {allowed:g} to {allowed_2:g}</source>
      <translation>{key} ist {value}, erlaubt ist {allowed:g} bis {allowed_2:g}</translation>
    </message>
    <message>
      <source>the objects are no mapping from id to name</source>
      <translation>die Objekte sind keine Zuordnung von Nummern zu Namen</translation>
    </message>
    <message>
      <source>write {{"1": "dog"}}</source>
      <translation>schreiben Sie {{"1": "Hund"}}</translation>
    </message>
    <message>
      <source>is no valid JSON</source>
      <translation>ist kein gültiges JSON</translation>
    </message>
    <message>
      <source>is no numpy array</source>
      <translation>ist kein Array von numpy</translation>
    </message>
    <message>
      <source>write it again with numpy</source>
      <translation>schreiben Sie es noch einmal mit numpy</translation>
    </message>
    <message>
      <source>holds Python objects, which could run code when read</source>
      <translation>enthält Python-Objekte, die beim Lesen Code ausführen könnten</translation>
    </message>
    <message>
      <source>store plain numbers</source>
      <translation>speichern Sie bloße Zahlen</translation>
    </message>
    <message>
      <source>has a header that is no numpy array's</source>
      <translation>hat einen Kopf, der nicht zu einem Array von numpy gehört</translation>
    </message>
    <message>
      <source>declares {nbytes} bytes but {file_size} are there</source>
      <translation>gibt {nbytes} Bytes an, aber es sind {file_size} da</translation>
    </message>
    <message>
      <source>ends after {data} of {count} bytes</source>
      <translation>endet nach {data} von {count} Bytes</translation>
    </message>
    <message>
      <source>holds no '{name}' (it holds {held})</source>
      <translation>enthält kein „{name}“ (enthalten ist {held})</translation>
    </message>
    <message>
      <source>store '{name}'</source>
      <translation>speichern Sie „{name}“</translation>
    </message>
    <message>
      <source>is no npz file or is damaged</source>
      <translation>ist keine npz-Datei oder ist beschädigt</translation>
    </message>
    <message>
      <source>is damaged</source>
      <translation>ist beschädigt</translation>
    </message>
    <message>
      <source>frames {first}:{end} select nothing of {total} frames</source>
      <translation>die Bilder {first}:{end} wählen nichts von {total} Bildern</translation>
    </message>
    <message>
      <source>give a range within 0:{total}</source>
      <translation>geben Sie einen Bereich in 0:{total}</translation>
    </message>
    <message>
      <source>is {here} x {here_2} but the first frame is {size} x {size_2}</source>
      <translation>ist {here} x {here_2}, aber das erste Bild ist {size} x {size_2}</translation>
    </message>
    <message>
      <source>make it as large as {first}</source>
      <translation>machen Sie es so groß wie {first}</translation>
    </message>
    <message>
      <source>is cut short</source>
      <translation>ist abgeschnitten</translation>
    </message>
    <message>
      <source>is not a PNG file</source>
      <translation>ist keine PNG-Datei</translation>
    </message>
    <message>
      <source>holds no pixels</source>
      <translation>enthält keine Pixel</translation>
    </message>
    <message>
      <source>does not start with a PNG header</source>
      <translation>beginnt nicht mit dem Kopf eines PNG</translation>
    </message>
    <message>
      <source>declares {header} bits and colour type {header_2}</source>
      <translation>gibt {header} Bit und Farbart {header_2} an</translation>
    </message>
    <message>
      <source>write it again</source>
      <translation>schreiben Sie es neu</translation>
    </message>
    <message>
      <source>cannot be decoded</source>
      <translation>kann nicht gelesen werden</translation>
    </message>
    <message>
      <source>is damaged (a checksum does not match)</source>
      <translation>ist beschädigt (eine Prüfsumme stimmt nicht)</translation>
    </message>
    <message>
      <source>a procedural clip needs at least one frame, one pixel and one shape</source>
      <translation>ein erzeugter Clip braucht mindestens ein Bild, ein Pixel und eine Form</translation>
    </message>
    <message>
      <source>holds another clip</source>
      <translation>enthält einen anderen Clip</translation>
    </message>
    <message>
      <source>choose another folder</source>
      <translation>wählen Sie einen anderen Ordner</translation>
    </message>
    <message>
      <source>cannot be written ({strerror})</source>
      <translation>kann nicht geschrieben werden ({strerror})</translation>
    </message>
    <message>
      <source>there is no procedural clip '{name}'</source>
      <translation>es gibt keinen erzeugten Clip „{name}“</translation>
    </message>
    <message>
      <source>cannot be decoded ({strerror})</source>
      <translation>kann nicht gelesen werden ({strerror})</translation>
    </message>
    <message>
      <source>none of its frames can be decoded</source>
      <translation>keines der Bilder kann gelesen werden</translation>
    </message>
    <message>
      <source>holds no frame</source>
      <translation>enthält kein Bild</translation>
    </message>
    <message>
      <source>give a video with pictures</source>
      <translation>geben Sie ein Video mit Bildern</translation>
    </message>
    <message>
      <source>holds sound but no pictures</source>
      <translation>enthält Ton, aber keine Bilder</translation>
    </message>
    <message>
      <source>holds no pictures</source>
      <translation>enthält keine Bilder</translation>
    </message>
    <message>
      <source>is stored in a codec that is not known here</source>
      <translation>ist mit einem Codec gespeichert, der hier nicht bekannt ist</translation>
    </message>
    <message>
      <source>is no video, or its header is missing or damaged</source>
      <translation>ist kein Video, oder sein Kopf fehlt oder ist beschädigt</translation>
    </message>
    <message>
      <source>record or copy it again</source>
      <translation>nehmen Sie es neu auf oder kopieren Sie es noch einmal</translation>
    </message>
    <message>
      <source>'{text}' is no goal</source>
      <translation>„{text}“ ist kein Ziel</translation>
    </message>
    <message>
      <source>write "psnr&gt;=26" or "gain&lt;0.1dB/min"</source>
      <translation>schreiben Sie "psnr&gt;=26" oder "gain&lt;0.1dB/min"</translation>
    </message>
    <message>
      <source>there is no preset '{name}'</source>
      <translation>es gibt keine Voreinstellung „{name}“</translation>
    </message>
    <message>
      <source>use one of {join}</source>
      <translation>benutzen Sie eine von {join}</translation>
    </message>
    <message>
      <source>there is no setting {unknown}</source>
      <translation>es gibt keine Einstellung {unknown}</translation>
    </message>
    <message>
      <source>correct these settings</source>
      <translation>berichtigen Sie diese Einstellungen</translation>
    </message>
    <message>
      <source>there is no effect {unknown}</source>
      <translation>es gibt keinen Effekt {unknown}</translation>
    </message>
    <message>
      <source>'{name}' cannot be switched on: {lacking}</source>
      <translation>„{name}“ kann nicht eingeschaltet werden: {lacking}</translation>
    </message>
    <message>
      <source>leave out +{name}</source>
      <translation>lassen Sie +{name} weg</translation>
    </message>
    <message>
      <source>'{item}' says neither + nor -</source>
      <translation>„{item}“ sagt weder + noch -</translation>
    </message>
    <message>
      <source>write +{item} or -{item_2}, auto or all</source>
      <translation>schreiben Sie +{item} oder -{item_2}, auto oder all</translation>
    </message>
    <message>
      <source>'{name}' is switched both on and off</source>
      <translation>„{name}“ ist sowohl ein- als auch ausgeschaltet</translation>
    </message>
    <message>
      <source>choose one</source>
      <translation>wählen Sie eines</translation>
    </message>
    <message>
      <source>the depth holds no valid value</source>
      <translation>die Tiefe enthält keinen gültigen Wert</translation>
    </message>
    <message>
      <source>take it away or --ignore depth</source>
      <translation>nehmen Sie sie weg oder benutzen Sie --ignore depth</translation>
    </message>
    <message>
      <source>the {kind} is for frame {frame} of {frames}</source>
      <translation>die Vorgabe ({kind}) ist für Bild {frame} von {frames}</translation>
    </message>
    <message>
      <source>count from 0</source>
      <translation>zählen Sie ab 0</translation>
    </message>
    <message>
      <source>the {kind}'s label is {label}</source>
      <translation>die Nummer der Vorgabe ({kind}) ist {label}</translation>
    </message>
    <message>
      <source>use 1 to 254</source>
      <translation>benutzen Sie 1 bis 254</translation>
    </message>
    <message>
      <source>the box {tolist} has no area inside the {size} x {size_2} frame</source>
      <translation>der Kasten {tolist} hat keine Fläche im Bild von {size} x {size_2}</translation>
    </message>
    <message>
      <source>give x0, y0, x1, y1 in pixels of the source</source>
      <translation>geben Sie x0, y0, x1, y1 in Pixeln der Quelle</translation>
    </message>
    <message>
      <source>the scribble has no points</source>
      <translation>der Strich hat keine Punkte</translation>
    </message>
    <message>
      <source>draw at least one</source>
      <translation>zeichnen Sie mindestens einen</translation>
    </message>
    <message>
      <source>is {dtype} {shape} for a clip of {clip} frames</source>
      <translation>ist {dtype} {shape} für einen Clip von {clip} Bildern</translation>
    </message>
    <message>
      <source>give numbers (T, H, W), one plane per frame</source>
      <translation>geben Sie Zahlen (T, H, W), je Bild eine Ebene</translation>
    </message>
    <message>
      <source>holds no finite value</source>
      <translation>enthält keinen endlichen Wert</translation>
    </message>
    <message>
      <source>take another file</source>
      <translation>nehmen Sie eine andere Datei</translation>
    </message>
    <message>
      <source>holds no model (no config.json)</source>
      <translation>enthält kein Modell (kein config.json)</translation>
    </message>
    <message>
      <source>give a folder with config.json and weights</source>
      <translation>geben Sie einen Ordner mit config.json und Gewichten</translation>
    </message>
    <message>
      <source>the transformers package has no {class_name} or is not installed</source>
      <translation>das Paket transformers hat kein {class_name} oder ist nicht installiert</translation>
    </message>
    <message>
      <source>install transformers 4.56 or newer</source>
      <translation>installieren Sie transformers 4.56 oder neuer</translation>
    </message>
    <message>
      <source>cannot be loaded as {class_name} ({error})</source>
      <translation>kann nicht als {class_name} geladen werden ({error})</translation>
    </message>
    <message>
      <source>give a complete folder of that kind of model</source>
      <translation>geben Sie einen vollständigen Ordner dieser Art von Modell</translation>
    </message>
    <message>
      <source>holds a '{kind}' model</source>
      <translation>enthält ein Modell der Art „{kind}“</translation>
    </message>
    <message>
      <source>give one of {sorted}</source>
      <translation>geben Sie eines von {sorted}</translation>
    </message>
    <message>
      <source>give one of {join}</source>
      <translation>geben Sie eines von {join}</translation>
    </message>
    <message>
      <source>names no object</source>
      <translation>nennt kein Objekt</translation>
    </message>
    <message>
      <source>give e.g. 'a red cup'</source>
      <translation>geben Sie zum Beispiel „a red cup“</translation>
    </message>
    <message>
      <source>shows no {phrases}</source>
      <translation>zeigt {phrases} nicht</translation>
    </message>
    <message>
      <source>give other words or a box</source>
      <translation>geben Sie andere Worte oder einen Kasten</translation>
    </message>
    <message>
      <source>no object is visible in any frame</source>
      <translation>in keinem Bild ist ein Objekt sichtbar</translation>
    </message>
    <message>
      <source>give masks, or a box with --box</source>
      <translation>geben Sie Masken, oder einen Kasten mit --box</translation>
    </message>
    <message>
      <source>no object was found where the boxes are</source>
      <translation>wo die Kästen sind, wurde kein Objekt gefunden</translation>
    </message>
    <message>
      <source>draw the box closer</source>
      <translation>ziehen Sie den Kasten enger</translation>
    </message>
    <message>
      <source>there is no variant {unknown}</source>
      <translation>es gibt keine Variante {unknown}</translation>
    </message>
    <message>
      <source>{seconds} s at {fps} pictures a second, {time_mode} from frame {frame} make no film</source>
      <translation>{seconds} s bei {fps} Bildern in der Sekunde, {time_mode} ab Bild {frame}, geben keinen Film</translation>
    </message>
    <message>
      <source>{short_side} pixels are no picture size</source>
      <translation>{short_side} Pixel sind keine Bildgröße</translation>
    </message>
    <message>
      <source>give 1 to 8192</source>
      <translation>geben Sie 1 bis 8192</translation>
    </message>
    <message>
      <source>is a file</source>
      <translation>ist eine Datei</translation>
    </message>
    <message>
      <source>give a folder or a name ending in .mp4</source>
      <translation>geben Sie einen Ordner oder einen Namen, der auf .mp4 endet</translation>
    </message>
    <message>
      <source>shows no object</source>
      <translation>zeigt kein Objekt</translation>
    </message>
    <message>
      <source>is {width} x {height}, the scene was made from {made_width} x {made_height}</source>
      <translation>ist {width} x {height}, die Szene wurde aus {made_width} x {made_height} gemacht</translation>
    </message>
    <message>
      <source>give the scene's own clip</source>
      <translation>geben Sie den Clip der Szene</translation>
    </message>
    <message>
      <source>has no frame {absent}, which the scene has</source>
      <translation>hat kein Bild {absent}, die Szene schon</translation>
    </message>
    <message>
      <source>cannot encode a picture of {shape}</source>
      <translation>ein Bild der Form {shape} kann nicht kodiert werden</translation>
    </message>
    <message>
      <source>the run ended without a scene</source>
      <translation>der Lauf endete ohne Szene</translation>
    </message>
    <message>
      <source>has tracks over {shape} frames, the clip has {clip}</source>
      <translation>hat Spuren über {shape} Bilder, der Clip hat {clip}</translation>
    </message>
    <message>
      <source>is no RGBA picture</source>
      <translation>ist kein RGBA-Bild</translation>
    </message>
    <message>
      <source>holds tracks but no Gaussians</source>
      <translation>enthält Spuren, aber keine Gaussians</translation>
    </message>
    <message>
      <source>give a scene written by optimize</source>
      <translation>geben Sie eine Szene, die optimize geschrieben hat</translation>
    </message>
    <message>
      <source>there is no frame {value}, the scene has {scene}</source>
      <translation>es gibt kein Bild {value}, die Szene hat {scene}</translation>
    </message>
    <message>
      <source>there is no checkpoint to resume from</source>
      <translation>es gibt keinen Prüfpunkt, von dem es weitergehen könnte</translation>
    </message>
    <message>
      <source>start without --resume</source>
      <translation>beginnen Sie ohne --resume</translation>
    </message>
    <message>
      <source>the checkpoint is of another clip or effect plan (differs in {names})</source>
      <translation>der Prüfpunkt gehört zu einem anderen Clip oder Effektplan (verschieden: {names})</translation>
    </message>
    <message>
      <source>start without --resume or use the run folder of this clip</source>
      <translation>beginnen Sie ohne --resume oder nehmen Sie den Laufordner dieses Clips</translation>
    </message>
    <message>
      <source>the checkpoint's tensors do not match their checksum</source>
      <translation>die Tensoren des Prüfpunkts passen nicht zu ihrer Prüfsumme</translation>
    </message>
    <message>
      <source>the checkpoint's tensors cannot be read</source>
      <translation>die Tensoren des Prüfpunkts können nicht gelesen werden</translation>
    </message>
    <message>
      <source>checkpoint format {format} is newer than {value}</source>
      <translation>das Prüfpunktformat {format} ist neuer als {value}</translation>
    </message>
    <message>
      <source>update GenMOJO Studio</source>
      <translation>aktualisieren Sie GenMOJO Studio</translation>
    </message>
    <message>
      <source>the checkpoint's JSON cannot be read</source>
      <translation>das JSON des Prüfpunkts kann nicht gelesen werden</translation>
    </message>
    <message>
      <source>the optimisation gives non-finite numbers again and again</source>
      <translation>die Optimierung ergibt immer wieder nicht endliche Zahlen</translation>
    </message>
    <message>
      <source>start from the last checkpoint with smaller learning rates</source>
      <translation>beginnen Sie am letzten Prüfpunkt mit kleineren Lernraten</translation>
    </message>
    <message>
      <source>no object has a visible pixel with depth</source>
      <translation>kein Objekt hat ein sichtbares Pixel mit Tiefe</translation>
    </message>
    <message>
      <source>check the masks</source>
      <translation>prüfen Sie die Masken</translation>
    </message>
    <message>
      <source>there is no method '{method}'</source>
      <translation>es gibt kein Verfahren „{method}“</translation>
    </message>
    <message>
      <source>has no cameras</source>
      <translation>hat keine Kameras</translation>
    </message>
    <message>
      <source>complete the clip before carrying points</source>
      <translation>vervollständigen Sie den Clip, bevor Sie Punkte mitführen</translation>
    </message>
    <message>
      <source>the Gaussians of {name} fill the view: {what}</source>
      <translation>die Gaussians von {name} füllen die Ansicht: {what}</translation>
    </message>
    <message>
      <source>go on from the last checkpoint with smaller learning rates</source>
      <translation>fahren Sie am letzten Prüfpunkt mit kleineren Lernraten fort</translation>
    </message>
    <message>
      <source>'{name}' cannot be changed during a run</source>
      <translation>„{name}“ kann während eines Laufs nicht geändert werden</translation>
    </message>
    <message>
      <source>change it before the next start</source>
      <translation>ändern Sie es vor dem nächsten Start</translation>
    </message>
    <message>
      <source>{name} cannot be {value}</source>
      <translation>{name} kann nicht {value} sein</translation>
    </message>
    <message>
      <source>give {kind} from {low:g} to {high:g}</source>
      <translation>geben Sie {kind} von {low:g} bis {high:g}</translation>
    </message>
    <message>
      <source>there is no run folder to resume from</source>
      <translation>es gibt keinen Laufordner, mit dem es weitergehen könnte</translation>
    </message>
    <message>
      <source>give --run-dir</source>
      <translation>geben Sie --run-dir</translation>
    </message>
    <message>
      <source>there is no scene yet</source>
      <translation>es gibt noch keine Szene</translation>
    </message>
    <message>
      <source>let the run reach its first preview</source>
      <translation>lassen Sie den Lauf bis zu seiner ersten Vorschau kommen</translation>
    </message>
    <message>
      <source>has no {name}</source>
      <translation>hat kein {name}</translation>
    </message>
    <message>
      <source>complete the clip before asking for its motion</source>
      <translation>vervollständigen Sie den Clip, bevor Sie nach seiner Bewegung fragen</translation>
    </message>
    <message>
      <source>there is no prior '{name}'</source>
      <translation>es gibt keinen Prior „{name}“</translation>
    </message>
    <message>
      <source>use embedded, none or zero123:DIR</source>
      <translation>benutzen Sie embedded, none oder zero123:DIR</translation>
    </message>
    <message>
      <source>cannot be made ({strerror})</source>
      <translation>kann nicht angelegt werden ({strerror})</translation>
    </message>
    <message>
      <source>the prior {kind} has no mean views</source>
      <translation>der Prior {kind} hat keine mittleren Ansichten</translation>
    </message>
    <message>
      <source>use sds or x0</source>
      <translation>benutzen Sie sds oder x0</translation>
    </message>
    <message>
      <source>is no safetensors file</source>
      <translation>ist keine safetensors-Datei</translation>
    </message>
    <message>
      <source>holds the state of another network (differs in {name})</source>
      <translation>enthält den Zustand eines anderen Netzes (verschieden: {name})</translation>
    </message>
    <message>
      <source>use another folder</source>
      <translation>nehmen Sie einen anderen Ordner</translation>
    </message>
    <message>
      <source>does not exist</source>
      <translation>gibt es nicht</translation>
    </message>
    <message>
      <source>train one with `genmojo train-prior` or use --prior none</source>
      <translation>trainieren Sie einen mit `genmojo train-prior` oder benutzen Sie --prior none</translation>
    </message>
    <message>
      <source>is larger than {value} MiB</source>
      <translation>ist größer als {value} MiB</translation>
    </message>
    <message>
      <source>has format {format}, this program reads {value}</source>
      <translation>hat Format {format}, dieses Programm liest {value}</translation>
    </message>
    <message>
      <source>does not match its checksum</source>
      <translation>passt nicht zu seiner Prüfsumme</translation>
    </message>
    <message>
      <source>get the file again</source>
      <translation>besorgen Sie die Datei noch einmal</translation>
    </message>
    <message>
      <source>holds tensors that its architecture has not</source>
      <translation>enthält Tensoren, die sein Aufbau nicht hat</translation>
    </message>
    <message>
      <source>has neither {join}</source>
      <translation>hat keines von {join}</translation>
    </message>
    <message>
      <source>give a complete model in diffusers' layout</source>
      <translation>geben Sie ein vollständiges Modell in der Anordnung von diffusers</translation>
    </message>
    <message>
      <source>is no folder</source>
      <translation>ist kein Ordner</translation>
    </message>
    <message>
      <source>give a model in diffusers' layout</source>
      <translation>geben Sie ein Modell in der Anordnung von diffusers</translation>
    </message>
    <message>
      <source>holds an original checkpoint</source>
      <translation>enthält einen ursprünglichen Checkpoint</translation>
    </message>
    <message>
      <source>convert it first with the script for Zero123 in diffusers/scripts</source>
      <translation>wandeln Sie ihn erst mit dem Skript für Zero123 in diffusers/scripts um</translation>
    </message>
    <message>
      <source>is told {numbers} numbers of a camera, {camera} gives another count</source>
      <translation>bekommt {numbers} Zahlen einer Kamera, {camera} gibt eine andere Anzahl</translation>
    </message>
    <message>
      <source>name the kind of model it is</source>
      <translation>nennen Sie die Art des Modells</translation>
    </message>
    <message>
      <source>has a schedule '{kind}' predicting '{target}'</source>
      <translation>hat einen Zeitplan „{kind}“, der {target} vorhersagt</translation>
    </message>
    <message>
      <source>use a model with scaled_linear betas that predicts epsilon</source>
      <translation>nehmen Sie ein Modell mit scaled_linear, das epsilon vorhersagt</translation>
    </message>
    <message>
      <source>is missing or holds no config.json</source>
      <translation>fehlt oder enthält kein config.json</translation>
    </message>
    <message>
      <source>holds no safetensors and {files} bin files</source>
      <translation>enthält keine safetensors und {files} bin-Dateien</translation>
    </message>
    <message>
      <source>save the model as safetensors</source>
      <translation>speichern Sie das Modell als safetensors</translation>
    </message>
    <message>
      <source>the package {library} is not installed</source>
      <translation>das Paket {library} ist nicht installiert</translation>
    </message>
    <message>
      <source>install genmojo-studio[zero123]</source>
      <translation>installieren Sie genmojo-studio[zero123]</translation>
    </message>
    <message>
      <source>cannot be loaded as {name} ({reason})</source>
      <translation>kann nicht als {name} geladen werden ({reason})</translation>
    </message>
    <message>
      <source>get the model as safetensors</source>
      <translation>besorgen Sie das Modell als safetensors</translation>
    </message>
    <message>
      <source>holds no Linear '{key}'</source>
      <translation>enthält kein Linear „{key}“</translation>
    </message>
    <message>
      <source>there is no rasteriser for device '{device}'</source>
      <translation>es gibt keinen Rasterisierer für das Gerät „{device}“</translation>
    </message>
    <message>
      <source>use cpu or cuda</source>
      <translation>benutzen Sie cpu oder cuda</translation>
    </message>
    <message>
      <source>torch sees no CUDA device</source>
      <translation>torch sieht kein CUDA-Gerät</translation>
    </message>
    <message>
      <source>use --device cpu</source>
      <translation>benutzen Sie --device cpu</translation>
    </message>
    <message>
      <source>gsplat is not installed</source>
      <translation>gsplat ist nicht installiert</translation>
    </message>
    <message>
      <source>install genmojo-studio[cuda] or use --device cpu</source>
      <translation>installieren Sie genmojo-studio[cuda] oder benutzen Sie --device cpu</translation>
    </message>
    <message>
      <source>{drawn} splats cover {entries} tiles of a {width} x {height} image, the limit is {value}; the widest is splat {argmax} with {max} tiles</source>
      <translation>{drawn} Splats bedecken {entries} Kacheln eines Bildes von {width} x {height}, die Grenze ist {value}; der breiteste ist Splat {argmax} mit {max} Kacheln</translation>
    </message>
    <message>
      <source>remove or shrink splats that fill the view, or render a smaller image</source>
      <translation>entfernen oder verkleinern Sie Splats, die die Ansicht füllen, oder zeichnen Sie ein kleineres Bild</translation>
    </message>
    <message>
      <source>detached_channels is {detached} of {features} channels</source>
      <translation>detached_channels ist {detached} von {features} Kanälen</translation>
    </message>
    <message>
      <source>features have shape {shape}, expected ({count}, C)</source>
      <translation>features haben die Form {shape}, erwartet ist ({count}, C)</translation>
    </message>
    <message>
      <source>{name} has shape {shape}, expected {shape_2}</source>
      <translation>{name} hat die Form {shape}, erwartet ist {shape_2}</translation>
    </message>
    <message>
      <source>holds no point that a person placed</source>
      <translation>enthält keinen Punkt, den jemand gesetzt hat</translation>
    </message>
    <message>
      <source>place points first</source>
      <translation>erst Punkte setzen</translation>
    </message>
    <message>
      <source>cannot be written ({reason})</source>
      <translation>kann nicht geschrieben werden ({reason})</translation>
    </message>
    <message>
      <source>choose another place or free some space</source>
      <translation>wählen Sie einen anderen Ort oder schaffen Sie Platz</translation>
    </message>
    <message>
      <source>is a folder</source>
      <translation>ist ein Ordner</translation>
    </message>
    <message>
      <source>give a file name</source>
      <translation>geben Sie einen Dateinamen</translation>
    </message>
    <message>
      <source>does not exist or is no file</source>
      <translation>gibt es nicht oder ist keine Datei</translation>
    </message>
    <message>
      <source>check the name</source>
      <translation>prüfen Sie den Namen</translation>
    </message>
    <message>
      <source>'{or}' cannot name a camera path</source>
      <translation>„{or}“ kann kein Name eines Kamerapfads sein</translation>
    </message>
    <message>
      <source>rename it</source>
      <translation>benennen Sie ihn um</translation>
    </message>
    <message>
      <source>has no camera path '{name}'</source>
      <translation>hat keinen Kamerapfad „{name}“</translation>
    </message>
    <message>
      <source>it has {known}</source>
      <translation>es gibt {known}</translation>
    </message>
    <message>
      <source>has columns of different lengths</source>
      <translation>hat Spalten verschiedener Länge</translation>
    </message>
    <message>
      <source>what was written does not read back the same</source>
      <translation>was geschrieben wurde, liest sich anders zurück</translation>
    </message>
    <message>
      <source>check the disk</source>
      <translation>prüfen Sie den Datenträger</translation>
    </message>
    <message>
      <source>is too large for a camera path</source>
      <translation>ist für einen Kamerapfad zu groß</translation>
    </message>
    <message>
      <source>cannot be read</source>
      <translation>kann nicht gelesen werden</translation>
    </message>
    <message>
      <source>is no JSON</source>
      <translation>ist kein JSON</translation>
    </message>
    <message>
      <source>its camera paths are damaged</source>
      <translation>die Kamerapfade darin sind beschädigt</translation>
    </message>
    <message>
      <source>is not COCO keypoints as we know them</source>
      <translation>ist nicht COCO mit Punkten, wie wir es kennen</translation>
    </message>
    <message>
      <source>give images, categories and annotations with keypoints</source>
      <translation>geben Sie images, categories und annotations mit keypoints</translation>
    </message>
    <message>
      <source>has two annotations of '{name}' in image {image} and nothing that says which is which</source>
      <translation>hat zwei Annotationen von '{name}' in Bild {image} und nichts, was sie unterscheidet</translation>
    </message>
    <message>
      <source>give each object a category or a track_id</source>
      <translation>geben Sie jedem Objekt eine Kategorie oder eine track_id</translation>
    </message>
    <message>
      <source>has no tracks or no visibility</source>
      <translation>hat keine tracks oder keine visibility</translation>
    </message>
    <message>
      <source>give CoTracker's result as npz</source>
      <translation>geben Sie das Ergebnis von CoTracker als npz</translation>
    </message>
    <message>
      <source>tracks {shape} and visibility {shape_2} do not fit</source>
      <translation>Spuren {shape} und Sichtbarkeit {shape_2} passen nicht zusammen</translation>
    </message>
    <message>
      <source>store (T, N, 2) and (T, N)</source>
      <translation>speichern Sie (T, N, 2) und (T, N)</translation>
    </message>
    <message>
      <source>does not say the image size</source>
      <translation>sagt nicht, wie groß das Bild ist</translation>
    </message>
    <message>
      <source>give --size WIDTHxHEIGHT</source>
      <translation>geben Sie --size BREITExHÖHE</translation>
    </message>
    <message>
      <source>has object or state of another shape</source>
      <translation>hat object oder state in einer anderen Form</translation>
    </message>
    <message>
      <source>holds no track of points or skeletons</source>
      <translation>enthält keine Spur von Punkten oder Skeletten</translation>
    </message>
    <message>
      <source>speaks of {total} frames</source>
      <translation>spricht von {total} Bildern</translation>
    </message>
    <message>
      <source>'{text}' is no place</source>
      <translation>'{text}' ist kein Ort</translation>
    </message>
    <message>
      <source>'{or}' is no whole number</source>
      <translation>„{or}“ ist keine ganze Zahl</translation>
    </message>
    <message>
      <source>declares a document type, which could read other files</source>
      <translation>gibt einen Dokumenttyp an, der andere Dateien lesen könnte</translation>
    </message>
    <message>
      <source>export it from CVAT again</source>
      <translation>exportieren Sie es noch einmal aus CVAT</translation>
    </message>
    <message>
      <source>is no XML in UTF-8</source>
      <translation>ist kein XML in UTF-8</translation>
    </message>
    <message>
      <source>give CVAT's video XML 1.1</source>
      <translation>geben Sie CVATs Video-XML 1.1</translation>
    </message>
    <message>
      <source>has no rows bodyparts and coords</source>
      <translation>hat keine Zeilen bodyparts und coords</translation>
    </message>
    <message>
      <source>give DeepLabCut's csv</source>
      <translation>geben Sie die csv-Datei von DeepLabCut</translation>
    </message>
    <message>
      <source>is no csv text</source>
      <translation>ist kein csv-Text</translation>
    </message>
    <message>
      <source>'{text}' is no number</source>
      <translation>„{text}“ ist keine Zahl</translation>
    </message>
    <message>
      <source>a stored edit cannot be read</source>
      <translation>eine gespeicherte Änderung kann nicht gelesen werden</translation>
    </message>
    <message>
      <source>open a backup copy</source>
      <translation>öffnen Sie eine Sicherungskopie</translation>
    </message>
    <message>
      <source>unpacks to {declared} MiB, the limit is {value}</source>
      <translation>wird entpackt {declared} MiB groß, die Grenze ist {value}</translation>
    </message>
    <message>
      <source>track {point} is visible in frame {frame} but has no position</source>
      <translation>Spur {point} ist in Bild {frame} sichtbar, hat aber keinen Ort</translation>
    </message>
    <message>
      <source>t is {shape} and xy {shape_2}, expected (N,) and (N, 2) numbers</source>
      <translation>t ist {shape} und xy {shape_2}, erwartet sind Zahlen (N,) und (N, 2)</translation>
    </message>
    <message>
      <source>holds no query</source>
      <translation>enthält keine Anfrage</translation>
    </message>
    <message>
      <source>give at least one point</source>
      <translation>geben Sie mindestens einen Punkt</translation>
    </message>
    <message>
      <source>has a time that is no whole frame or a position that is not finite</source>
      <translation>hat eine Zeit, die kein ganzes Bild ist, oder einen Ort, der nicht endlich ist</translation>
    </message>
    <message>
      <source>xy {shape}, state {shape_2} and object {shape_3} do not belong together</source>
      <translation>xy {shape}, state {shape_2} und object {shape_3} gehören nicht zusammen</translation>
    </message>
    <message>
      <source>xyz has the shape {shape}, expected {frames}</source>
      <translation>xyz hat die Form {shape}, erwartet ist {frames}</translation>
    </message>
    <message>
      <source>state has values over 3</source>
      <translation>state hat Werte über 3</translation>
    </message>
    <message>
      <source>the image size is {size}</source>
      <translation>die Bildgröße ist {size}</translation>
    </message>
    <message>
      <source>track {point} is visible in frame {frame} but has no finite position</source>
      <translation>Spur {point} ist in Bild {frame} sichtbar, hat aber keinen endlichen Ort</translation>
    </message>
    <message>
      <source>tracks {shape} and visible {shape_2} do not belong together</source>
      <translation>Spuren {shape} und visible {shape_2} gehören nicht zusammen</translation>
    </message>
    <message>
      <source>does not say the image size its pixels belong to</source>
      <translation>sagt nicht, zu welcher Bildgröße die Pixel gehören</translation>
    </message>
    <message>
      <source>add size = (width, height)</source>
      <translation>fügen Sie size = (Breite, Höhe) hinzu</translation>
    </message>
    <message>
      <source>has no {absent} (it has {nothing})</source>
      <translation>hat kein {absent} (vorhanden: {nothing})</translation>
    </message>
    <message>
      <source>{key} holds {dtype}, expected numbers</source>
      <translation>{key} enthält {dtype}, erwartet sind Zahlen</translation>
    </message>
    <message>
      <source>size has {size} numbers, expected width and height</source>
      <translation>size hat {size} Zahlen, erwartet sind Breite und Höhe</translation>
    </message>
    <message>
      <source>holds no Gaussians</source>
      <translation>enthält keine Gaussians</translation>
    </message>
    <message>
      <source>take a file written by optimize</source>
      <translation>nehmen Sie eine Datei, die optimize geschrieben hat</translation>
    </message>
    <message>
      <source>there is no object {strange}</source>
      <translation>es gibt kein Objekt {strange}</translation>
    </message>
    <message>
      <source>choose from {ids}</source>
      <translation>wählen Sie aus {ids}</translation>
    </message>
    <message>
      <source>give a folder</source>
      <translation>geben Sie einen Ordner</translation>
    </message>
    <message>
      <source>is no PLY file</source>
      <translation>ist keine PLY-Datei</translation>
    </message>
    <message>
      <source>ends before its {count} splats do</source>
      <translation>endet, bevor seine {count} Splats es tun</translation>
    </message>
    <message>
      <source>copy it again</source>
      <translation>kopieren Sie es noch einmal</translation>
    </message>
    <message>
      <source>has no column {missing}, so it holds no Gaussian splats</source>
      <translation>hat keine Spalte {missing}, enthält also keine Gaussian-Splats</translation>
    </message>
    <message>
      <source>names no vertices</source>
      <translation>nennt keine Ecken</translation>
    </message>
    <message>
      <source>holds {count} splats, allowed are {value}</source>
      <translation>enthält {count} Splats, erlaubt sind {value}</translation>
    </message>
    <message>
      <source>thin it out first</source>
      <translation>dünnen Sie es erst aus</translation>
    </message>
    <message>
      <source>has {name} that are not finite</source>
      <translation>hat {name}, die nicht endlich sind</translation>
    </message>
    <message>
      <source>holds more than {value} splats</source>
      <translation>enthält mehr als {value} Splats</translation>
    </message>
    <message>
      <source>cannot be read ({lower})</source>
      <translation>kann nicht gelesen werden ({lower})</translation>
    </message>
    <message>
      <source>is no binary little-endian PLY</source>
      <translation>ist kein binäres PLY in Little-Endian</translation>
    </message>
    <message>
      <source>save it again in that form</source>
      <translation>speichern Sie es noch einmal in dieser Form</translation>
    </message>
    <message>
      <source>begins with the element '{element}', expected vertex</source>
      <translation>beginnt mit dem Element „{element}“, erwartet ist vertex</translation>
    </message>
    <message>
      <source>has the column '{words}', which cannot be read</source>
      <translation>hat die Spalte „{words}“, die nicht gelesen werden kann</translation>
    </message>
    <message>
      <source>holds no PLY file</source>
      <translation>enthält keine PLY-Datei</translation>
    </message>
    <message>
      <source>give a PLY file or a folder of them</source>
      <translation>geben Sie eine PLY-Datei oder einen Ordner mit solchen</translation>
    </message>
    <message>
      <source>has frames of {counts} to {counts_2} splats</source>
      <translation>hat Bilder von {counts} bis {counts_2} Splats</translation>
    </message>
    <message>
      <source>give files with equally many splats</source>
      <translation>geben Sie Dateien mit gleich vielen Splats</translation>
    </message>
    <message>
      <source>exists already</source>
      <translation>gibt es schon</translation>
    </message>
    <message>
      <source>open it, or choose another name</source>
      <translation>öffnen Sie es, oder wählen Sie einen anderen Namen</translation>
    </message>
    <message>
      <source>belongs to a clip of {frames} frames of {size}, not {frames_2} of {size_2}</source>
      <translation>gehört zu einem Clip von {frames} Bildern der Größe {size}, nicht {frames_2} der Größe {size_2}</translation>
    </message>
    <message>
      <source>choose another file</source>
      <translation>wählen Sie eine andere Datei</translation>
    </message>
    <message>
      <source>there is no edit {seq}</source>
      <translation>es gibt keine Änderung {seq}</translation>
    </message>
    <message>
      <source>is open in another program</source>
      <translation>ist in einem anderen Programm geöffnet</translation>
    </message>
    <message>
      <source>close it there, or save a copy</source>
      <translation>schließen Sie es dort, oder speichern Sie eine Kopie</translation>
    </message>
    <message>
      <source>is no GenMOJO project</source>
      <translation>ist kein Projekt von GenMOJO</translation>
    </message>
    <message>
      <source>give a file written by the annotator</source>
      <translation>geben Sie eine Datei, die das Annotieren geschrieben hat</translation>
    </message>
    <message>
      <source>is of version {version}, this program knows up to {value}</source>
      <translation>hat Version {version}, dieses Programm kennt bis zu {value}</translation>
    </message>
    <message>
      <source>open it with a newer version</source>
      <translation>öffnen Sie es mit einer neueren Version</translation>
    </message>
    <message>
      <source>is no project file or cannot be opened ({error})</source>
      <translation>ist keine Projektdatei oder kann nicht geöffnet werden ({error})</translation>
    </message>
    <message>
      <source>cannot be opened ({error})</source>
      <translation>kann nicht geöffnet werden ({error})</translation>
    </message>
    <message>
      <source>check the permissions</source>
      <translation>prüfen Sie die Rechte</translation>
    </message>
    <message>
      <source>is no project file or is damaged</source>
      <translation>ist keine Projektdatei oder ist beschädigt</translation>
    </message>
    <message>
      <source>cannot be saved ({error})</source>
      <translation>kann nicht gespeichert werden ({error})</translation>
    </message>
    <message>
      <source>free some space or save a copy elsewhere</source>
      <translation>schaffen Sie Platz, oder speichern Sie eine Kopie anderswo</translation>
    </message>
    <message>
      <source>lacks rows of its history</source>
      <translation>es fehlen Zeilen seiner Geschichte</translation>
    </message>
    <message>
      <source>has no edit {seq}</source>
      <translation>hat keine Änderung {seq}</translation>
    </message>
    <message>
      <source>cannot be read ({error})</source>
      <translation>kann nicht gelesen werden ({error})</translation>
    </message>
    <message>
      <source>open it again</source>
      <translation>öffne es neu</translation>
    </message>
    <message>
      <source>holds a history that does not fit together</source>
      <translation>enthält eine Geschichte, die nicht zusammenpasst</translation>
    </message>
    <message>
      <source>cannot be copied ({error})</source>
      <translation>kann nicht kopiert werden ({error})</translation>
    </message>
    <message>
      <source>free some space</source>
      <translation>schaffen Sie Platz</translation>
    </message>
    <message>
      <source>holds another history by now</source>
      <translation>enthält inzwischen einen anderen Verlauf</translation>
    </message>
    <message>
      <source>is truncated or damaged</source>
      <translation>ist abgeschnitten oder beschädigt</translation>
    </message>
    <message>
      <source>copy or make the file again</source>
      <translation>kopieren oder erzeugen Sie die Datei noch einmal</translation>
    </message>
    <message>
      <source>is longer than {value} MiB</source>
      <translation>ist länger als {value} MiB</translation>
    </message>
    <message>
      <source>is a folder, not a file</source>
      <translation>ist ein Ordner, keine Datei</translation>
    </message>
    <message>
      <source>is empty (0 bytes)</source>
      <translation>ist leer (0 Bytes)</translation>
    </message>
    <message>
      <source>make the file again</source>
      <translation>erzeugen Sie die Datei noch einmal</translation>
    </message>
    <message>
      <source>is not an HDF5 file</source>
      <translation>ist keine HDF5-Datei</translation>
    </message>
    <message>
      <source>give a scene written by genmojo optimize</source>
      <translation>geben Sie eine Szene, die genmojo optimize geschrieben hat</translation>
    </message>
    <message>
      <source>another program is writing it or died while writing</source>
      <translation>ein anderes Programm schreibt es gerade oder endete beim Schreiben</translation>
    </message>
    <message>
      <source>close that program or make the file again</source>
      <translation>beenden Sie jenes Programm, oder erzeugen Sie die Datei noch einmal</translation>
    </message>
    <message>
      <source>is a virtual dataset (its values lie in other files)</source>
      <translation>ist ein virtueller Datensatz (seine Werte liegen in anderen Dateien)</translation>
    </message>
    <message>
      <source>keeps its values in another file</source>
      <translation>hält seine Werte in einer anderen Datei</translation>
    </message>
    <message>
      <source>declares {size:.1f} GiB, the limit is {value}</source>
      <translation>gibt {size:.1f} GiB an, die Grenze ist {value}</translation>
    </message>
    <message>
      <source>has chunks of {chunk} MiB</source>
      <translation>hat Stücke von {chunk} MiB</translation>
    </message>
    <message>
      <source>would expand {value} times and more to {size} MiB</source>
      <translation>würde sich {value}-mal und mehr auf {size} MiB ausdehnen</translation>
    </message>
    <message>
      <source>groups are nested deeper than {value}</source>
      <translation>Gruppen sind tiefer als {value} verschachtelt</translation>
    </message>
    <message>
      <source>holds more than {value} objects</source>
      <translation>enthält mehr als {value} Objekte</translation>
    </message>
    <message>
      <source>declares {total:.0f} GiB of data</source>
      <translation>gibt {total:.0f} GiB Daten an</translation>
    </message>
    <message>
      <source>a checksum does not match or data is missing</source>
      <translation>eine Prüfsumme stimmt nicht, oder Daten fehlen</translation>
    </message>
    <message>
      <source>is not valid JSON ({error})</source>
      <translation>ist kein gültiges JSON ({error})</translation>
    </message>
    <message>
      <source>uses the unknown HDF5 filter {code}</source>
      <translation>benutzt den unbekannten HDF5-Filter {code}</translation>
    </message>
    <message>
      <source>use gzip</source>
      <translation>benutzen Sie gzip</translation>
    </message>
    <message>
      <source>its structure is damaged</source>
      <translation>der Aufbau ist beschädigt</translation>
    </message>
    <message>
      <source>is a link to elsewhere and is not followed</source>
      <translation>ist ein Verweis nach anderswo und wird nicht verfolgt</translation>
    </message>
    <message>
      <source>store the data</source>
      <translation>speichern Sie die Daten</translation>
    </message>
    <message>
      <source>is a second name of another object</source>
      <translation>ist ein zweiter Name eines anderen Objekts</translation>
    </message>
    <message>
      <source>store the data once</source>
      <translation>speichern Sie die Daten einmal</translation>
    </message>
    <message>
      <source>the attribute dilation_px2 is {dilation:g}</source>
      <translation>das Attribut dilation_px2 ist {dilation:g}</translation>
    </message>
    <message>
      <source>the attribute up is no unit vector</source>
      <translation>das Attribut up ist kein Einheitsvektor</translation>
    </message>
    <message>
      <source>is no JSON {name}</source>
      <translation>ist kein JSON {name}</translation>
    </message>
    <message>
      <source>this scene cannot be saved: {faults}</source>
      <translation>diese Szene kann nicht gespeichert werden: {faults}</translation>
    </message>
    <message>
      <source>see genmojo validate</source>
      <translation>siehe genmojo validate</translation>
    </message>
    <message>
      <source>is an HDF5 file but no genmojo4d scene</source>
      <translation>ist eine HDF5-Datei, aber keine Szene von genmojo4d</translation>
    </message>
    <message>
      <source>has format version '{version}', this program reads {scene_layout}</source>
      <translation>hat Formatversion „{version}“, dieses Programm liest {scene_layout}</translation>
    </message>
    <message>
      <source>update the program</source>
      <translation>aktualisieren Sie das Programm</translation>
    </message>
    <message>
      <source>was not finished by the program that wrote it</source>
      <translation>wurde von dem Programm, das es schrieb, nicht beendet</translation>
    </message>
    <message>
      <source>make it again</source>
      <translation>erzeugen Sie es noch einmal</translation>
    </message>
    <message>
      <source>its attributes are damaged</source>
      <translation>seine Attribute sind beschädigt</translation>
    </message>
    <message>
      <source>tracks have the shape {shape}, expected (tracks, 2, nodes, frames)</source>
      <translation>Spuren haben die Form {shape}, erwartet ist (Spuren, 2, Knoten, Bilder)</translation>
    </message>
    <message>
      <source>names {names} tracks and {nodes} nodes for {owners} and {points}</source>
      <translation>nennt {names} Spuren und {nodes} Knoten für {owners} und {points}</translation>
    </message>
    <message>
      <source>give a SLEAP analysis file</source>
      <translation>geben Sie eine Analysedatei von SLEAP</translation>
    </message>
    <message>
      <source>a visible point has no position</source>
      <translation>ein sichtbarer Punkt hat keinen Ort</translation>
    </message>
    <message>
      <source>has no points or no occluded</source>
      <translation>hat keine points oder kein occluded</translation>
    </message>
    <message>
      <source>give a TAP-Vid npz</source>
      <translation>geben Sie ein npz von TAP-Vid</translation>
    </message>
    <message>
      <source>points {shape} and occluded {shape_2} do not fit</source>
      <translation>Punkte {shape} und occluded {shape_2} passen nicht zusammen</translation>
    </message>
    <message>
      <source>object has the shape {shape} for {points} tracks</source>
      <translation>object hat die Form {shape} für {points} Spuren</translation>
    </message>
    <message>
      <source>is a pickle, which can run code when it is opened</source>
      <translation>ist ein Pickle, das beim Öffnen Code ausführen kann</translation>
    </message>
    <message>
      <source>agree to open it in a closed process (--allow-pickle), or give npz</source>
      <translation>stimmen Sie dem Öffnen in einem abgeschlossenen Prozess zu (--allow-pickle), oder geben Sie npz</translation>
    </message>
    <message>
      <source>is larger than {value} GiB</source>
      <translation>ist größer als {value} GiB</translation>
    </message>
    <message>
      <source>do not trust this file</source>
      <translation>vertrauen Sie dieser Datei nicht</translation>
    </message>
    <message>
      <source>holds no video '{video}'</source>
      <translation>enthält kein Video „{video}“</translation>
    </message>
    <message>
      <source>holds no video</source>
      <translation>enthält kein Video</translation>
    </message>
    <message>
      <source>it has {none}</source>
      <translation>es gibt {none}</translation>
    </message>
    <message>
      <source>takes more than {value} s to open</source>
      <translation>braucht mehr als {value} s zum Öffnen</translation>
    </message>
    <message>
      <source>has no consent to export times of people</source>
      <translation>hat keine Einwilligung, Arbeitszeiten von Menschen zu exportieren</translation>
    </message>
    <message>
      <source>ask them and set the consent flag</source>
      <translation>fragen Sie sie, und setzen Sie die Einwilligung</translation>
    </message>
    <message>
      <source>has {shape} frames, the clip has {frames}</source>
      <translation>hat {shape} Bilder, der Clip hat {frames}</translation>
    </message>
    <message>
      <source>export it from this clip</source>
      <translation>exportieren Sie es aus diesem Clip</translation>
    </message>
    <message>
      <source>holds no tracks</source>
      <translation>enthält keine Spuren</translation>
    </message>
    <message>
      <source>give a file with tracks</source>
      <translation>geben Sie eine Datei mit Spuren</translation>
    </message>
    <message>
      <source>has names of its tracks that do not fit them</source>
      <translation>hat Namen von Spuren, die nicht zu ihnen passen</translation>
    </message>
    <message>
      <source>export it again</source>
      <translation>exportieren Sie es noch einmal</translation>
    </message>
    <message>
      <source>a window of {window} frames and {memory_gib:g} GiB are no limits</source>
      <translation>ein Fenster von {window} Bildern und {memory_gib:g} GiB sind keine Grenzen</translation>
    </message>
    <message>
      <source>give {value} to {value_2} frames and GiB from 0</source>
      <translation>{value} bis {value_2} Bilder und GiB ab 0 angeben</translation>
    </message>
    <message>
      <source>gave tracks {shape} for {shape_2}</source>
      <translation>ergab Spuren {shape} für {shape_2}</translation>
    </message>
    <message>
      <source>there is no model '{hub}'</source>
      <translation>es gibt kein Modell „{hub}“</translation>
    </message>
    <message>
      <source>would download and run code by torch.hub</source>
      <translation>würde über torch.hub Code herunterladen und ausführen</translation>
    </message>
    <message>
      <source>agree first, or give a local checkout</source>
      <translation>stimmen Sie erst zu, oder geben Sie eine lokale Kopie</translation>
    </message>
    <message>
      <source>holds no cotracker/predictor.py</source>
      <translation>enthält kein cotracker/predictor.py</translation>
    </message>
    <message>
      <source>give a checkout of CoTracker</source>
      <translation>geben Sie den Quelltext von CoTracker</translation>
    </message>
    <message>
      <source>CoTracker stopped: {last}</source>
      <translation>CoTracker hielt an: {last}</translation>
    </message>
    <message>
      <source>check checkout, checkpoint and memory</source>
      <translation>prüfen Sie Quelltext, Gewichte und Speicher</translation>
    </message>
    <message>
      <source>was stopped before it was done</source>
      <translation>wurde angehalten, bevor es fertig war</translation>
    </message>
    <message>
      <source>is no checkpoint</source>
      <translation>ist kein Checkpoint</translation>
    </message>
    <message>
      <source>give CoTracker's weights (.pth)</source>
      <translation>geben Sie die Gewichte von CoTracker (.pth)</translation>
    </message>
    <message>
      <source>CoTracker ran out of memory, or the system ended it</source>
      <translation>CoTracker ging der Speicher aus, oder das System hat es beendet</translation>
    </message>
    <message>
      <source>close other programs, allow more memory, or use a smaller clip</source>
      <translation>andere Programme schließen, mehr Speicher erlauben oder einen kleineren Clip nehmen</translation>
    </message>
    <message>
      <source>has no masks, and points are tracked inside them</source>
      <translation>hat keine Masken, und Punkte werden in ihnen verfolgt</translation>
    </message>
    <message>
      <source>give masks or boxes</source>
      <translation>geben Sie Masken oder Kästen</translation>
    </message>
    <message>
      <source>a query is outside frames 0 to {clip}</source>
      <translation>eine Anfrage liegt außerhalb der Bilder 0 bis {clip}</translation>
    </message>
    <message>
      <source>a query names an object outside 0 to {objects}</source>
      <translation>eine Anfrage nennt ein Objekt außerhalb von 0 bis {objects}</translation>
    </message>
    <message>
      <source>holds no Gaussians to track with</source>
      <translation>enthält keine Gaussians, mit denen verfolgt werden könnte</translation>
    </message>
    <message>
      <source>there is no query</source>
      <translation>es gibt keine Anfrage</translation>
    </message>
    <message>
      <source>give t (N,) and xy (N, 2)</source>
      <translation>geben Sie t (N,) und xy (N, 2)</translation>
    </message>
    <message>
      <source>asks at frame {scene}, the scene has frames 0 to {scene_2}</source>
      <translation>fragt bei Bild {scene}, die Szene hat die Bilder 0 bis {scene_2}</translation>
    </message>
    <message>
      <source>asks at {tolist}, outside the {size} x {size_2} picture</source>
      <translation>fragt bei {tolist}, außerhalb des Bildes von {size} x {size_2}</translation>
    </message>
    <message>
      <source>give raster pixels of the clip</source>
      <translation>geben Sie Rasterpixel des Clips</translation>
    </message>
    <message>
      <source>has no object {unknown} to carry points</source>
      <translation>hat kein Objekt {unknown}, das Punkte tragen könnte</translation>
    </message>
    <message>
      <source>optimise it with that object's masks</source>
      <translation>optimieren Sie sie mit den Masken dieses Objekts</translation>
    </message>
    <message>
      <source>was cancelled</source>
      <translation>wurde abgebrochen</translation>
    </message>
    <message>
      <source>there is no tracker '{name}'</source>
      <translation>es gibt keinen Verfolger „{name}“</translation>
    </message>
    <message>
      <source>'{name}' needs a path</source>
      <translation>„{name}“ braucht einen Pfad</translation>
    </message>
    <message>
      <source>write {name}:PATH</source>
      <translation>schreiben Sie {name}:PFAD</translation>
    </message>
    <message>
      <source>a query asks at frame {frames}, the clip has 0 to {frames_2}</source>
      <translation>eine Anfrage gilt Bild {frames}, der Clip hat 0 bis {frames_2}</translation>
    </message>
    <message>
      <source>has {scene} frames, the clip {clip}</source>
      <translation>hat {scene} Bilder, der Clip {clip}</translation>
    </message>
    <message>
      <source>optimise this clip first</source>
      <translation>optimieren Sie erst diesen Clip</translation>
    </message>
    <message>
      <source>has {width} x {height} pixels, the clip {value} x {value_2}</source>
      <translation>hat {width} x {height} Pixel, der Clip {value} x {value_2}</translation>
    </message>
    <message>
      <source>is a scene of another clip: their pictures are alike by {alike:.2f} only</source>
      <translation>ist die Szene eines anderen Clips: die Bilder ähneln sich nur zu {alike:.2f}</translation>
    </message>
    <message>
      <source>has {shape} frames, the clip {clip}</source>
      <translation>hat {shape} Bilder, der Clip {clip}</translation>
    </message>
    <message>
      <source>has visible points up to {reach:.0f}, {reach_2:.0f}, the clip has {size} x {size_2} pixels</source>
      <translation>hat sichtbare Punkte bis {reach:.0f}, {reach_2:.0f}, der Clip hat {size} x {size_2} Pixel</translation>
    </message>
    <message>
      <source>store the size its pixels belong to: size = (width, height)</source>
      <translation>speichern Sie die Größe, zu der die Pixel gehören: size = (Breite, Höhe)</translation>
    </message>
    <message>
      <source>has no object {object_id} to track</source>
      <translation>hat kein Objekt {object_id} zum Verfolgen</translation>
    </message>
    <message>
      <source>{frames} frames of {size} are compared with {frames_2} of {size_2}</source>
      <translation>{frames} Bilder der Größe {size} werden mit {frames_2} der Größe {size_2} verglichen</translation>
    </message>
    <message>
      <source>give the same clip</source>
      <translation>geben Sie denselben Clip</translation>
    </message>
    <message>
      <source>has no point in common with the first</source>
      <translation>hat keinen Punkt mit dem ersten gemeinsam</translation>
    </message>
    <message>
      <source>{frames} frames of {size} x {size_2} pixels cannot be annotated</source>
      <translation>{frames} Bilder von {size} x {size_2} Pixeln können nicht annotiert werden</translation>
    </message>
    <message>
      <source>there is no track {track}</source>
      <translation>es gibt keine Spur {track}</translation>
    </message>
    <message>
      <source>there is no object {object_id}</source>
      <translation>es gibt kein Objekt {object_id}</translation>
    </message>
    <message>
      <source>object {object_id} already has a point {number}</source>
      <translation>Objekt {object_id} hat schon einen Punkt {number}</translation>
    </message>
    <message>
      <source>'{reason}' is no reason</source>
      <translation>„{reason}“ ist kein Grund</translation>
    </message>
    <message>
      <source>track {track} says nothing about frame {blank} and {blank_2} others</source>
      <translation>Spur {track} sagt nichts über Bild {blank} und {blank_2} weitere</translation>
    </message>
    <message>
      <source>annotate them first</source>
      <translation>annotieren Sie sie erst</translation>
    </message>
    <message>
      <source>track {track} is locked</source>
      <translation>Spur {track} ist gesperrt</translation>
    </message>
    <message>
      <source>unlock it first</source>
      <translation>entsperren Sie sie erst</translation>
    </message>
    <message>
      <source>{track} has nothing from frame {value} on</source>
      <translation>{track} hat ab Bild {value} nichts</translation>
    </message>
    <message>
      <source>choose an earlier frame</source>
      <translation>ein früheres Bild wählen</translation>
    </message>
    <message>
      <source>a track cannot be joined to itself</source>
      <translation>eine Spur lässt sich nicht mit sich selbst verbinden</translation>
    </message>
    <message>
      <source>choose another one</source>
      <translation>eine andere wählen</translation>
    </message>
    <message>
      <source>{track} has places of its own in {known} of these frames, the first is {known_2}</source>
      <translation>{track} hat in {known} dieser Bilder eigene Orte, zuerst in Bild {known_2}</translation>
    </message>
    <message>
      <source>swap or join the two instead</source>
      <translation>stattdessen beide tauschen oder verbinden</translation>
    </message>
    <message>
      <source>frames {first} to {last} are not in 0 to {frames}</source>
      <translation>die Bilder {first} bis {last} liegen nicht in 0 bis {frames}</translation>
    </message>
    <message>
      <source>the place {xy} of a key is not finite</source>
      <translation>der Ort {xy} eines Schlüssels ist nicht endlich</translation>
    </message>
    <message>
      <source>{track} has no key in frame {value}</source>
      <translation>{track} hat keinen Schlüssel in Bild {value}</translation>
    </message>
    <message>
      <source>there is no state {state}</source>
      <translation>es gibt keinen Zustand {state}</translation>
    </message>
    <message>
      <source>{track} has no key before frame {value}</source>
      <translation>{track} hat keinen Schlüssel vor Bild {value}</translation>
    </message>
    <message>
      <source>{track} is locked</source>
      <translation>{track} ist gesperrt</translation>
    </message>
    <message>
      <source>{shape} tracks over {shape_2} frames are compared with {shape_3} over {shape_4}</source>
      <translation>{shape} Spuren über {shape_2} Bilder werden mit {shape_3} über {shape_4} verglichen</translation>
    </message>
    <message>
      <source>the truth holds no position</source>
      <translation>die Wahrheit enthält keinen Ort</translation>
    </message>
    <message>
      <source>no point has a position in space</source>
      <translation>kein Punkt hat einen Ort im Raum</translation>
    </message>
    <message>
      <source>the review of point {number} does not stand where this is possible</source>
      <translation>die Prüfung von Punkt {number} lässt das so nicht zu</translation>
    </message>
    <message>
      <source>point {number} was not returned by a reviewer, so there is nothing to call fixed</source>
      <translation>Punkt {number} hat niemand zurückgegeben, es gibt also nichts, was behoben wäre</translation>
    </message>
    <message>
      <source>a reviewer returns it in step 4</source>
      <translation>zurückgegeben wird er in Schritt 4</translation>
    </message>
    <message>
      <source>point {number} is approved already</source>
      <translation>Punkt {number} ist schon freigegeben</translation>
    </message>
    <message>
      <source>return it or reject it to say otherwise</source>
      <translation>geben Sie ihn zurück oder verwerfen Sie ihn, wenn Sie es anders sehen</translation>
    </message>
    <message>
      <source>point {number} is rejected already</source>
      <translation>Punkt {number} ist schon verworfen</translation>
    </message>
    <message>
      <source>approve it or return it to say otherwise</source>
      <translation>geben Sie ihn frei oder zurück, wenn Sie es anders sehen</translation>
    </message>
    <message>
      <source>every frame has masks already</source>
      <translation>jedes Bild hat schon Masken</translation>
    </message>
    <message>
      <source>correct the mask instead</source>
      <translation>berichtigen Sie stattdessen die Maske</translation>
    </message>
    <message>
      <source>the object has no mask to follow</source>
      <translation>das Objekt hat keine Maske, der zu folgen wäre</translation>
    </message>
    <message>
      <source>draw a box where it is seen</source>
      <translation>ziehen Sie ein Rechteck, wo es zu sehen ist</translation>
    </message>
    <message>
      <source>a mask of {mask} frames does not fit a clip of {clip}</source>
      <translation>eine Maske von {mask} Bildern passt nicht zu einem Clip von {clip}</translation>
    </message>
    <message>
      <source>open the clip that it was drawn on</source>
      <translation>öffnen Sie den Clip, auf dem sie gezeichnet wurde</translation>
    </message>
    <message>
      <source>lacks the mask of edit {number}</source>
      <translation>die Maske der Änderung {number} fehlt</translation>
    </message>
    <message>
      <source>frame {frame} shows only what is not part of the object</source>
      <translation>Bild {frame} zeigt nur, was nicht zum Objekt gehört</translation>
    </message>
    <message>
      <source>draw on the object too, or a box round it</source>
      <translation>zeichnen Sie auch auf das Objekt oder ein Rechteck darum</translation>
    </message>
    <message>
      <source>has {found} frames of {found_2}, the project's clip has {wanted} of {wanted_2}</source>
      <translation>hat {found} Bilder von {found_2}, der Clip des Projekts hat {wanted} von {wanted_2}</translation>
    </message>
    <message>
      <source>choose the clip that was annotated</source>
      <translation>den annotierten Clip wählen</translation>
    </message>
    <message>
      <source>give another file</source>
      <translation>geben Sie eine andere Datei an</translation>
    </message>
    <message>
      <source>holds no tracks we know</source>
      <translation>enthält keine Spuren, die wir kennen</translation>
    </message>
    <message>
      <source>give one of {patterns}</source>
      <translation>geben Sie eine von {patterns} an</translation>
    </message>
    <message>
      <source>is no HDF5 file or is damaged</source>
      <translation>ist keine HDF5-Datei oder beschädigt</translation>
    </message>
    <message>
      <source>is no export this program knows</source>
      <translation>ist kein Export, den dieses Programm kennt</translation>
    </message>
    <message>
      <source>is no file of shortcuts</source>
      <translation>ist keine Datei mit Tastenkürzeln</translation>
    </message>
    <message>
      <source>choose one that was exported here</source>
      <translation>wähle eine, die hier exportiert wurde</translation>
    </message>
    <message>
      <source>was written by a newer program</source>
      <translation>wurde von einem neueren Programm geschrieben</translation>
    </message>
    <message>
      <source>export it with this version</source>
      <translation>exportiere sie mit dieser Version</translation>
    </message>
    <message>
      <source>gives {id} a key that there is not</source>
      <translation>gibt {id} eine Taste, die es nicht gibt</translation>
    </message>
    <message>
      <source>put it right in the file</source>
      <translation>berichtige es in der Datei</translation>
    </message>
    <message>
      <source>gives {key} to {id}, which clashes with {other}</source>
      <translation>gibt {key} an {id}, was sich mit {other} nicht verträgt</translation>
    </message>
    <message>
      <source>'{name}' is no kind of file that the app opens</source>
      <translation>„{name}“ ist keine Art von Datei, die die App öffnet</translation>
    </message>
    <message>
      <source>open a clip folder, a video, a scene (.h5), a project (.genmojo) or a .ply</source>
      <translation>öffnen Sie einen Clip-Ordner, ein Video, eine Szene (.h5), ein Projekt (.genmojo) oder eine .ply-Datei</translation>
    </message>
    <message>
      <source>a picture of {width} x {height} pixels is more than the processor draws</source>
      <translation>ein Bild von {width} x {height} Pixeln ist mehr, als der Prozessor zeichnet</translation>
    </message>
    <message>
      <source>choose a smaller size</source>
      <translation>wählen Sie eine kleinere Größe</translation>
    </message>
    <message>
      <source>is no view</source>
      <translation>ist keine Ansicht</translation>
    </message>
    <message>
      <source>write for example: elevation 30 azimuth -15</source>
      <translation>schreiben Sie zum Beispiel: elevation 30 azimuth -15</translation>
    </message>
    <message>
      <source>this pose cannot be reached from the input camera by elevation, azimuth and roll</source>
      <translation>diese Pose lässt sich von der Eingangskamera aus mit Höhe, Azimut und Rollen nicht erreichen</translation>
    </message>
    <message>
      <source>the processor draws instead</source>
      <translation>stattdessen zeichnet der Prozessor</translation>
    </message>
    <message>
      <source>{snapshot} Gaussians are more than this driver can hold</source>
      <translation>{snapshot} Gaussians sind mehr, als dieser Treiber fasst</translation>
    </message>
    <message>
      <source>a picture of {size} x {size_2} pixels is more than this driver draws</source>
      <translation>ein Bild von {size} x {size_2} Pixeln ist mehr, als dieser Treiber zeichnet</translation>
    </message>
    <message>
      <source>there is no scene</source>
      <translation>es gibt keine Szene</translation>
    </message>
    <message>
      <source>open a scene or start a run</source>
      <translation>öffnen Sie eine Szene oder starten Sie einen Lauf</translation>
    </message>
    <message>
      <source>there is no Gaussian {row}</source>
      <translation>es gibt kein Gaussian {row}</translation>
    </message>
    <message>
      <source>{name} has shape {shape}, expected {wanted}</source>
      <translation>{name} hat die Form {shape}, erwartet ist {wanted}</translation>
    </message>
    <message>
      <source>OpenGL is not ready</source>
      <translation>OpenGL ist nicht bereit</translation>
    </message>
    <message>
      <source>show the view first</source>
      <translation>zeigen Sie die Ansicht erst</translation>
    </message>
    <message>
      <source>holds neither a scene nor a checkpoint</source>
      <translation>enthält weder eine Szene noch einen Prüfpunkt</translation>
    </message>
    <message>
      <source>start the run anew</source>
      <translation>starten Sie den Lauf neu</translation>
    </message>
    <message>
      <source>the run ended before its scene was written</source>
      <translation>der Lauf endete, bevor seine Szene geschrieben war</translation>
    </message>
    <message>
      <source>resume the run and try again</source>
      <translation>setzen Sie den Lauf fort und versuchen Sie es noch einmal</translation>
    </message>
    <message>
      <source>holds no tracks, and there are none to carry through it</source>
      <translation>enthält keine Spuren, und es gibt keine, die hindurchgeführt werden könnten</translation>
    </message>
    <message>
      <source>import tracks first</source>
      <translation>importieren Sie erst Spuren</translation>
    </message>
    <message>
      <source>another worker is optimising in this folder</source>
      <translation>ein anderer Prozess optimiert in diesem Ordner</translation>
    </message>
    <message>
      <source>attach to it</source>
      <translation>verbinden Sie sich mit ihm</translation>
    </message>
    <message>
      <source>no optimiser is at work in this folder</source>
      <translation>in diesem Ordner arbeitet kein Optimierer</translation>
    </message>
    <message>
      <source>open its scene or resume</source>
      <translation>öffnen Sie seine Szene, oder setzen Sie den Lauf fort</translation>
    </message>
    <message>
      <source>a run is going on here</source>
      <translation>hier ist ein Lauf im Gang</translation>
    </message>
    <message>
      <source>stop it or detach first</source>
      <translation>halten Sie ihn an, oder trennen Sie sich erst von ihm</translation>
    </message>
    <message>
      <source>a preview of {total} bytes does not fit {capacity}</source>
      <translation>eine Vorschau von {total} Bytes passt nicht in {capacity}</translation>
    </message>
    <message>
      <source>is no preview bus</source>
      <translation>ist kein Kanal für Vorschauen</translation>
    </message>
    <message>
      <source>{name} of type {dtype} cannot be a preview</source>
      <translation>{name} vom Typ {dtype} kann keine Vorschau sein</translation>
    </message>
    <message>
      <source>holds a preview of another program version</source>
      <translation>enthält eine Vorschau einer anderen Programmversion</translation>
    </message>
    <message>
      <source>cannot be opened</source>
      <translation>kann nicht geöffnet werden</translation>
    </message>
    <message>
      <source>a message of {body} bytes is too long</source>
      <translation>eine Nachricht von {body} Bytes ist zu lang</translation>
    </message>
    <message>
      <source>sent a message without a type</source>
      <translation>sandte eine Nachricht ohne Art</translation>
    </message>
    <message>
      <source>sent something that is no JSON</source>
      <translation>sandte etwas, das kein JSON ist</translation>
    </message>
    <message>
      <source>is no request for a run</source>
      <translation>ist keine Anforderung eines Laufs</translation>
    </message>
    <message>
      <source>start the run again</source>
      <translation>starten Sie den Lauf noch einmal</translation>
    </message>
    <message>
      <source>sent something that is no message</source>
      <translation>sandte etwas, das keine Nachricht ist</translation>
    </message>
    <message>
      <source>cannot be made ({lower})</source>
      <translation>kann nicht angelegt werden ({lower})</translation>
    </message>
    <message>
      <source>set GENMOJO_RUNS to a folder with room</source>
      <translation>setzen Sie GENMOJO_RUNS auf einen Ordner mit Platz</translation>
    </message>
    <message>
      <source>attach to it or choose another folder</source>
      <translation>verbinden Sie sich mit ihm, oder wählen Sie einen anderen Ordner</translation>
    </message>
    <message>
      <source>{value} are no steps</source>
      <translation>{value} sind keine Schritte</translation>
    </message>
    <message>
      <source>the run has not begun</source>
      <translation>der Lauf hat noch nicht begonnen</translation>
    </message>
    <message>
      <source>wait for the first scene</source>
      <translation>warten Sie auf die erste Szene</translation>
    </message>
    <message>
      <source>there is nothing to keep yet</source>
      <translation>es gibt noch nichts zu behalten</translation>
    </message>
    <message>
      <source>wait for the first step</source>
      <translation>warten Sie auf den ersten Schritt</translation>
    </message>
    <message>
      <source>wait for the first preview</source>
      <translation>warten Sie auf die erste Vorschau</translation>
    </message>
  </context>
</TS>
